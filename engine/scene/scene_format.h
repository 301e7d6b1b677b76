// The scene format is data: every object of a scene file with its keys. The reader, the hints for unknown keys, the
// published JSON Schema and the document are made of it; its rows are in scene_format.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// The published text of a key.
struct KeyText {
    std::string_view name;
    std::string_view help;
    std::string schema;         ///< members of its value's JSON Schema, without braces
    std::string words;          ///< Markdown that says what the value may be
    std::string default_value;  ///< JSON; empty: there is none
    bool required = false;
};

/// A named part of the format: an object with its keys, or a value that occurs in several places ("color").
struct Definition {
    std::string_view name;  ///< "scene" is the root
    std::string_view help;
    std::string schema;         ///< JSON Schema of a value, or of what an object has beside its keys
    std::string words;          ///< Markdown, for a value only
    std::vector<KeyText> keys;  ///< for an object only
    std::string other_keys;     ///< JSON Schema of the values of further keys; empty: there are none
    std::vector<const Definition*> uses;

    bool has_key(std::string_view key) const;
    /// Returns the key nearest to a misspelt one (nearest_word.h); empty when there is none.
    std::string_view nearest_key(std::string_view misspelt) const;
};

/// Returns the root, then all others, each after the first that uses it.
std::vector<const Definition*> scene_definitions();

}  // namespace drape
