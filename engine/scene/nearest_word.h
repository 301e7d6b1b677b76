// "Did you mean": the word that somebody may have wanted to write.
#pragma once

#include <span>
#include <string_view>

namespace drape {

/// The candidate nearest to a misspelt word: edit distance (insert, delete, replace a byte) at most 2 and less than the
/// candidate's length; the first of equally near ones; empty when there is none.
std::string_view nearest_word(std::string_view misspelt, std::span<const std::string_view> candidates);

}  // namespace drape
