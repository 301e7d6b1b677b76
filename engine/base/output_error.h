#pragma once

#include <stdexcept>
#include <string>
#include <system_error>

namespace drape {

// Thrown when a file or folder cannot be read or written; the program then ends with exit code 1. The text names the
// path, what was tried and the system's reason.
class OutputError : public std::runtime_error {
  public:
    explicit OutputError(const std::string& text) : std::runtime_error(text) {}
};

// Returns "cannot <action> '<path>': <text of the errno value>".
inline OutputError system_error_at(const std::string& action, const std::string& path, int errno_value) {
    return OutputError("cannot " + action + " '" + path + "': " + std::generic_category().message(errno_value));
}

}  // namespace drape
