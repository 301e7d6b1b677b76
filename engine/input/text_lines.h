// Reads files of text line by line.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "input/file_source.h"

namespace drape::input {

/// Hands out the lines of a file, one after another, without their ends (LF, CR LF, or CR) and a byte order mark.
class Lines {
  public:
    /// The file must outlive it.
    explicit Lines(FileSource& file) : file_(file) {}

    /// Returns whether there was another line. Throws OutputError for one that is too long.
    bool next(std::string_view& line);
    std::uint64_t number() const { return number_; }

  private:
    FileSource& file_;
    std::string text_;
    std::size_t begin_ = 0;
    std::uint64_t number_ = 0;
    bool ended_ = false;
};

/// Returns whether a line begins with three numbers, behind blanks, and reads them.
bool read_vertex(std::string_view line, std::array<double, 3>& vertex);

}  // namespace drape::input
