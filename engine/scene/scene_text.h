// Adds what the JSON library does not check or say: places in the text, and the lexical rules it is lax about.
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

/// Turns a byte offset into line and column. Lines end with \n, \r\n or \r.
class LineTable {
  public:
    explicit LineTable(std::string_view text);
    LineColumn at(std::size_t offset) const;
    /// Returns the offset of a place, clamped to the text.
    std::size_t offset_of(LineColumn place) const;

  private:
    std::vector<std::size_t> starts_{0};
    std::size_t size_;
};

struct TextFault {
    std::size_t offset;
    std::string message;
};

/// Arrays and objects may be nested this deep; a scene needs 8.
inline constexpr int scene_depth_limit = 64;

/// A scene may have this many values (numbers, words, texts, arrays and objects), an object this many keys. More take
/// the JSON library longer than anybody waits for an answer.
inline constexpr std::size_t scene_value_limit = 500'000;
inline constexpr std::size_t scene_key_limit = 1000;

/// Returns the first violation of: valid UTF-8, no control characters, numbers as JSON spells them, nesting and counts
/// within the limits. It says nothing about the rest of the grammar.
std::optional<TextFault> find_text_fault(std::string_view text);

/// Replaces every number that overflows a double by one of +-1e308 as long as before. The JSON library stops at such
/// numbers; this way they are refused like any other value too large for its field. It expects a text without fault.
std::string with_finite_numbers(std::string_view text);

/// Returns the commas after the last member of an object or an array, where JSON has none.
std::vector<std::size_t> trailing_commas(std::string_view text);

/// Returns text to quote in a message, cut after whole characters to at most `most` bytes.
std::string shortened(std::string_view text, std::size_t most = 40);

/// Returns where each key of an object is written: `object` is its text from `{` on, already parsed without error;
/// offsets (of the opening quote) are relative to it.
std::map<std::string, std::size_t> key_offsets(std::string_view object);

}  // namespace drape
