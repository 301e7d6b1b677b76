#pragma once

#include <json/value.h>

#include <string>

namespace drape {

// Returns the JSON text of a value: two spaces of indentation, what fits on one line stays on one line, keys sorted,
// bytes that are not UTF-8 as \xff, doubles with the fewest digits that read back as the same double (JsonCpp's own
// writers have one precision for all numbers). It ends with a newline. Throws OutputError naming the key when a double
// is not finite.
std::string json_text(const Json::Value& value);

// Returns it for a value inside another one whose lines begin with so many spaces, without the newline.
std::string json_text(const Json::Value& value, std::size_t indentation);

// Returns it on one line, without the newline.
std::string json_line(const Json::Value& value);

}  // namespace drape
