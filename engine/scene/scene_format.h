// The scene format as data: every object of a scene file with its keys. The reader, the hints for unknown keys, the
// published JSON Schema and the document are made of it; its rows are in scene_format.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// What is published of a key.
struct KeyText {
    std::string_view name;
    std::string_view help;
    std::string schema;         ///< members of its value's JSON Schema, without braces
    std::string words;          ///< Markdown: what the value may be
    std::string default_value;  ///< JSON; empty: the key has none
    bool required = false;
};

/// A named part of the format: an object with its keys, or a value that occurs in several places ("color").
struct Definition {
    std::string_view name;  ///< "scene" is the root
    std::string_view help;
    std::string schema;         ///< of a value: its JSON Schema; of an object: what it has beside its keys
    std::string words;          ///< of a value, Markdown
    std::vector<KeyText> keys;  ///< of an object
    std::string other_keys;     ///< JSON Schema of the values that keys beside these have; empty: there are none
    std::vector<const Definition*> uses;

    bool has_key(std::string_view key) const;
    /// The key nearest to a misspelt one (nearest_word.h); empty when there is none.
    std::string_view nearest_key(std::string_view misspelt) const;
};

/// The root, then all others, each after the first that uses it.
std::vector<const Definition*> scene_definitions();

}  // namespace drape
