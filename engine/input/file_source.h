// The bytes of a file that a user names. They are read when they are needed; files that may block or never end are
// refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/output_error.h"

namespace drape::input {

/// Returns "cannot read '<where>': <why>".
OutputError unreadable(const std::string& where, const std::string& why);

class FileSource {
  public:
    /// Throws OutputError if no file exists there, or if it is not a regular file.
    explicit FileSource(const std::filesystem::path& path);
    ~FileSource();
    FileSource(const FileSource&) = delete;

    const std::string& name() const { return name_; }
    std::uint64_t size() const { return size_; }
    /// Reads so many bytes from the present place on, or fewer where there are no more. Throws OutputError.
    std::size_t read(char* to, std::size_t count);
    void skip(std::uint64_t count);
    /// Returns all that is left. Throws OutputError where there is no memory for it.
    std::vector<std::uint8_t> rest();

  private:
    std::string name_;
    int descriptor_;
    std::uint64_t size_ = 0, place_ = 0;
};

/// Returns the name's extension in small letters, ".npy".
std::string extension_of(const std::filesystem::path& path);

}  // namespace drape::input
