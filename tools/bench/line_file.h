// A file of lines that grows by one whole line at a time, so that a killed run loses at most the last.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace drape::bench {

class LineFile {
  public:
    /// Tells `each` of every line of FILE, the last perhaps cut short; a missing file has none.
    LineFile(std::filesystem::path file, const std::function<void(const std::string& line)>& each);

    /// Appends a line and syncs. Throws OutputError.
    void add(const std::string& line);

  private:
    std::filesystem::path file_;
    bool ends_in_line_ = true;
};

}  // namespace drape::bench
