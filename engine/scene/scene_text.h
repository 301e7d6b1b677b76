// What the JSON library does not check or say: places in the text, and the lexical rules it is lax about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

struct LineColumn {
    std::uint32_t line;    ///< from 1
    std::uint32_t column;  ///< from 1, in bytes
};

/// Byte offset -> line and column. Lines end with \n, \r\n or \r.
class LineTable {
  public:
    explicit LineTable(std::string_view text);
    LineColumn at(std::size_t offset) const;
    /// The inverse, clamped to the text.
    std::size_t offset_of(LineColumn place) const;

  private:
    std::vector<std::size_t> starts_{0};
    std::size_t size_;
};

struct TextFault {
    std::size_t offset;
    std::string message;
};

/// Deepest nesting of arrays and objects accepted; a scene needs 8.
inline constexpr int scene_depth_limit = 64;

/// Most values (numbers, words, texts, arrays and objects) of a scene, and most keys of an object. More take the JSON
/// library longer than anybody waits for an answer.
inline constexpr std::size_t scene_value_limit = 500'000;
inline constexpr std::size_t scene_key_limit = 1000;

/// The first violation of: valid UTF-8, no control characters, numbers as JSON spells them, nesting and counts within
/// the limits. Says nothing about the rest of the grammar.
std::optional<TextFault> find_text_fault(std::string_view text);

/// The text with every number that overflows a double replaced by one of +-1e308, as long as before. The JSON
/// library stops at such numbers; this way they are refused like any other value too large for its field.
/// Expects a text without fault.
std::string with_finite_numbers(std::string_view text);

/// The commas that stand after the last member of an object or an array, where JSON has none.
std::vector<std::size_t> trailing_commas(std::string_view text);

/// Text to quote in a message: cut after whole characters to at most `most` bytes.
std::string shortened(std::string_view text, std::size_t most = 40);

/// Where each key of an object is written: `object` is its text from `{` on, already parsed without error;
/// offsets (of the opening quote) are relative to it.
std::map<std::string, std::size_t> key_offsets(std::string_view object);

}  // namespace drape
