#pragma once

#include <span>
#include <string_view>

namespace drape {

/// Returns the candidate nearest to a misspelt word: the edit distance (insert, delete, replace a byte) is at most 2
/// and less than the candidate's length. The first of equally near ones is taken; empty when there is none.
std::string_view nearest_word(std::string_view misspelt, std::span<const std::string_view> candidates);

}  // namespace drape
