#include "input/file_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>

#include "input/available_memory.h"

namespace drape::input {

OutputError unreadable(const std::string& where, const std::string& why) {
    return OutputError(fmt::format("cannot read '{}': {}", where, why));
}

// Without O_NONBLOCK a pipe that nobody writes to would never open.
FileSource::FileSource(const std::filesystem::path& path)
    : name_(path.string()), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat status {};
    const bool is_there = descriptor_ >= 0 && fstat(descriptor_, &status) == 0;
    const int error = is_there ? 0 : errno;
    if (!is_there || !S_ISREG(status.st_mode)) {
        if (descriptor_ >= 0) close(descriptor_);
        throw is_there ? unreadable(name_, "it is no file") : system_error_at("read", name_, error);
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

FileSource::~FileSource() { close(descriptor_); }

std::size_t FileSource::read(char* to, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = pread(descriptor_, to + done, count - done, static_cast<off_t>(place_));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw system_error_at("read", name_, errno);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
        place_ += static_cast<std::uint64_t>(got);
    }
    return done;
}

void FileSource::skip(std::uint64_t count) { place_ = std::min(size_, place_ + std::min(count, size_)); }

std::vector<std::uint8_t> FileSource::rest() {
    const std::uint64_t left = size_ - place_;
    expect_memory(fmt::format("'{}'", name_), left);
    std::vector<std::uint8_t> bytes(left);
    bytes.resize(read(reinterpret_cast<char*>(bytes.data()), bytes.size()));
    return bytes;
}

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension;
}

}  // namespace drape::input
