#pragma once

#include <unistd.h>

#include <utility>

namespace drape {

// Owns one open file descriptor; -1 means none.
class FileDescriptor {
  public:
    FileDescriptor() = default;
    explicit FileDescriptor(int value) : value_(value) {}
    FileDescriptor(FileDescriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    ~FileDescriptor() { close(); }

    int get() const { return value_; }
    explicit operator bool() const { return value_ >= 0; }

    // Returns close()'s result: on network file systems a full disk may show only here.
    int close() { return value_ < 0 ? 0 : ::close(std::exchange(value_, -1)); }

  private:
    int value_ = -1;
};

}  // namespace drape
