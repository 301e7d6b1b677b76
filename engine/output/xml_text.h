#pragma once

#include <string>
#include <string_view>

#include "base/printable_text.h"

namespace drape {

/// Escapes text for XML, SVG and HTML, in content and in attributes in double quotes, bytes that are not UTF-8 too.
/// Control characters but tab and line feed, which XML cannot say, become spaces.
inline std::string xml_text(std::string_view text) {
    std::string result;
    for (const char c : printable(text, Escaped::not_utf8)) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' ? ' ' : c;
    }
    return result;
}

}  // namespace drape
