#include "output/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

namespace drape {

namespace {

std::string hex(XXH128_hash_t hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

using HashState = std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)>;

HashState new_hash_state() {
    HashState state(XXH3_createState(), XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state.get());
    return state;
}

}  // namespace

std::string xxh3_128_hex(std::span<const std::byte> bytes) { return hex(XXH3_128bits(bytes.data(), bytes.size())); }

std::string xxh3_128_hex(std::string_view text) { return xxh3_128_hex(bytes_of(text)); }

AtomicFile::AtomicFile(OutputFolder& folder, std::string name)
    : folder_(folder),
      name_(std::move(name)),
      temporary_name_(fmt::format("{}.tmp-{}", name_, getpid())),
      hash_state_(new_hash_state()) {
    if (!is_plain_file_name(name_)) {
        throw OutputError(fmt::format("cannot write '{}': not a plain file name", folder_.path_of(name_)));
    }
    folder_.begin_writing();
    // O_EXCL also refuses to write through a symbolic link planted under this name.
    descriptor_ = FileDescriptor(
        openat(folder_.descriptor(), temporary_name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!descriptor_) throw error(errno);
}

AtomicFile::~AtomicFile() {
    if (!committed_) unlinkat(folder_.descriptor(), temporary_name_.c_str(), 0);
}

OutputError AtomicFile::error(int errno_value) const {
    return system_error_at("write", folder_.path_of(name_), errno_value);
}

void AtomicFile::append(std::span<const std::byte> bytes) {
    write_at(size_, bytes);
    XXH3_128bits_update(hash_state_.get(), bytes.data(), bytes.size());
    size_ += bytes.size();
}

void AtomicFile::rewrite(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (offset > size_ || bytes.size() > size_ - offset) {
        throw OutputError(fmt::format("cannot write '{}': bytes {} to {} lie beyond its end, {}",
                                      folder_.path_of(name_), offset, offset + bytes.size(), size_));
    }
    rewritten_ = true;
    write_at(offset, bytes);
}

void AtomicFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = pwrite(descriptor_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0) {
            if (errno == EINTR) continue;
            throw error(errno);
        }
        bytes = bytes.subspan(static_cast<size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
}

// After a rewrite, the hash of the appended bytes is no longer valid.
std::string AtomicFile::hash_written_bytes() const {
    if (!rewritten_) return hex(XXH3_128bits_digest(hash_state_.get()));
    const HashState state = new_hash_state();
    std::vector<std::byte> block(1 << 20);
    for (std::uint64_t offset = 0; offset < size_;) {
        const ssize_t count = pread(descriptor_.get(), block.data(), block.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) throw error(count < 0 ? errno : EIO);
        XXH3_128bits_update(state.get(), block.data(), static_cast<size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return hex(XXH3_128bits_digest(state.get()));
}

FileRecord AtomicFile::commit() {
    FileRecord record{name_, size_, hash_written_bytes()};
    if (fsync(descriptor_.get()) != 0) throw error(errno);
    if (descriptor_.close() != 0) throw error(errno);
    if (renameat(folder_.descriptor(), temporary_name_.c_str(), folder_.descriptor(), name_.c_str()) != 0) {
        throw error(errno);
    }
    committed_ = true;
    return record;
}

FileRecord write_file(OutputFolder& folder, const std::string& name, std::span<const std::byte> bytes) {
    AtomicFile file(folder, name);
    file.append(bytes);
    return file.commit();
}

std::string read_file(const std::filesystem::path& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (file) text << file.rdbuf();
    if (!file) throw system_error_at("read", path.string(), errno == 0 ? EIO : errno);
    return std::move(text).str();
}

namespace {

/// Returns 0, or the reason why not all was written.
int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written >= 0)
            text.remove_prefix(static_cast<size_t>(written));
        else if (errno != EINTR)
            return errno;
    }
    return 0;
}

/// A pipe or a device is written to directly: replacing it by a file would take it away from all others.
void write_into(const std::filesystem::path& path, std::string_view text) {
    const FileDescriptor descriptor(open(path.c_str(), O_WRONLY | O_CLOEXEC));
    const int error = descriptor ? write_all(descriptor.get(), text) : errno;
    if (error != 0) throw system_error_at("write", path.string(), error);
}

}  // namespace

void write_file(const std::filesystem::path& asked, std::string_view text) {
    std::error_code unknown;
    if (const auto there = std::filesystem::status(asked, unknown);
        std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
        return write_into(asked, text);
    // A link remains a link, to the new file, which need not have existed.
    std::filesystem::path path = asked;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(path, unknown); ++links)
        path = path.parent_path() / std::filesystem::read_symlink(path, unknown);
    const std::string beside = fmt::format("{}.tmp-{}", path.string(), getpid());
    FileDescriptor descriptor(open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!descriptor) throw system_error_at("write", path.string(), errno);
    const auto fail = [&](int error) {
        unlink(beside.c_str());
        throw system_error_at("write", path.string(), error);
    };
    if (const int error = write_all(descriptor.get(), text); error != 0) fail(error);
    if (fsync(descriptor.get()) != 0 || descriptor.close() != 0) fail(errno);
    if (rename(beside.c_str(), path.c_str()) != 0) fail(errno);
}

}  // namespace drape
