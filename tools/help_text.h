// Puts help texts in lines that a terminal of 80 columns shows whole.
#pragma once

#include <string>
#include <string_view>

namespace drape::cli {

constexpr std::size_t help_columns = 80;

/// Wraps words in lines of at most `columns` characters; a longer word stands alone. Where a line has a column of two
/// spaces or more, as in "npy   an array", what follows is indented to it.
std::string wrapped(std::string_view text, std::size_t columns);

/// Wraps the paragraphs of a command's details; lines that begin with a space (lists, examples) stay as they stand.
std::string reflowed(std::string_view text, std::size_t columns);

}  // namespace drape::cli
