#pragma once

#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "output/output_folder.h"

namespace drape {

// The manifest's record of one finished file.
struct FileRecord {
    std::string name;
    std::uint64_t bytes = 0;
    std::string hash;  // XXH3, 128 bits, 32 hexadecimal digits (as `xxhsum -H2` prints)

    bool operator==(const FileRecord&) const = default;
};

inline std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

// Returns the XXH3-128 of some bytes as 32 hexadecimal digits.
std::string xxh3_128_hex(std::span<const std::byte> bytes);
std::string xxh3_128_hex(std::string_view text);

// A file that appears under its name complete or not at all: it is written as <name>.tmp-<process id> in the same
// folder, synced, then renamed over any file of that name. Without commit() the destructor removes the temporary. Every
// member throws OutputError naming the path and the system's reason (a full disk shows in any of them).
class AtomicFile {
  public:
    AtomicFile(OutputFolder& folder, std::string name);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void append(std::span<const std::byte> bytes);
    // Overwrites bytes that were appended earlier (for a header that is known only at the end).
    void rewrite(std::uint64_t offset, std::span<const std::byte> bytes);
    std::uint64_t size() const { return size_; }
    // Returns the file for reading back before it has its own name.
    int descriptor() const { return descriptor_.get(); }

    FileRecord commit();

  private:
    OutputError error(int errno_value) const;
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
    std::string hash_written_bytes() const;

    OutputFolder& folder_;
    std::string name_;
    std::string temporary_name_;
    FileDescriptor descriptor_;
    bool committed_ = false;
    bool rewritten_ = false;
    std::uint64_t size_ = 0;
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> hash_state_;
};

FileRecord write_file(OutputFolder& folder, const std::string& name, std::span<const std::byte> bytes);

// Returns the bytes of a whole file in any folder. Throws OutputError.
std::string read_file(const std::filesystem::path& path);

// Writes a whole file in the same way, in any existing folder, for results that belong to no run. A symbolic link
// remains a link, to the new file; a pipe or a device is written to directly.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace drape
