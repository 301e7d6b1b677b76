// Knows keys that people bring along from other programs, and what they are called here.
#pragma once

#include <string_view>

namespace drape {

/// Returns what to write instead of `key` in an object of this kind ("box", "cloth", ...), as text after "expected";
/// empty when the key is no known habit.
std::string_view guessed_key(std::string_view object, std::string_view key);

}  // namespace drape
