#pragma once

#include <stdexcept>
#include <string>

namespace drape {

// A file or folder could not be read or written. The text names the path, what was tried and the system's
// reason. The program ends with exit code 1.
class OutputError : public std::runtime_error {
  public:
    explicit OutputError(const std::string& text) : std::runtime_error(text) {}
};

// "cannot <action> '<path>': <text of the errno value>".
OutputError system_error_at(const std::string& action, const std::string& path, int errno_value);

}  // namespace drape
