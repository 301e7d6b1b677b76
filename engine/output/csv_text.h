// Text within comma-separated values.
#pragma once

#include <string>

namespace drape {

/// A field by RFC 4180: in quotes where it needs them.
inline std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + "\"";
}

}  // namespace drape
