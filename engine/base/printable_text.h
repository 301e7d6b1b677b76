// Text of any bytes, such as a file's name, as messages and documents can hold it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace drape {

/// Bytes of the UTF-8 character that the text begins with (RFC 3629), 0 where it begins with none.
inline std::size_t utf8_length(std::string_view text) {
    const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned lead = byte(0);
    if (text.empty() || lead < 0x80) return std::min<std::size_t>(text.size(), 1);
    if (lead < 0xc2 || lead > 0xf4) return 0;
    const std::size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    const unsigned least = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;  // no longer than it need be
    const unsigned most = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;   // no surrogate, none beyond the last
    if (byte(1) < least || byte(1) > most) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (byte(i) >> 6 != 2) return 0;
    return length;
}

/// The bytes that `printable` writes as `\x1b`: each value stands for its own and those of the values before it.
enum class Escaped {
    not_utf8,       ///< bytes that are no character
    controls,       ///< control characters that are no line feeds
    every_control,  ///< line feeds too: a name stays on its line
};

/// The text in UTF-8 that reads the same but for what is escaped.
inline std::string printable(std::string_view text, Escaped escaped = Escaped::every_control) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        const auto last = static_cast<unsigned char>(character.back());
        const bool control = character == "\n" ? escaped == Escaped::every_control
                             : length == 1     ? escaped != Escaped::not_utf8 && (last < 0x20 || last == 0x7f)
                             : length == 2     ? escaped != Escaped::not_utf8 && character[0] == '\xc2' && last < 0xa0
                                               : false;
        if (length > 0 && !control)
            result += character;
        else
            for (const char c : character) result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        text.remove_prefix(character.size());
    }
    return result;
}

}  // namespace drape
