// Text within comma-separated values.
#pragma once

#include <string>

#include "base/printable_text.h"

namespace drape {

/// Returns a field by RFC 4180, in quotes where it needs them; no spreadsheet takes it for a formula, and control
/// characters are shown as \xff.
inline std::string csv_text(const std::string& text) {
    std::string shown = printable(text);
    if (shown.find_first_of("=+-@") == 0) shown.insert(0, "'");
    if (shown.find_first_of(",\"") == std::string::npos) return shown;
    std::string field = "\"";
    for (const char c : shown) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + "\"";
}

}  // namespace drape
