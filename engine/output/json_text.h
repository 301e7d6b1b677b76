#pragma once

#include <json/value.h>

#include <initializer_list>
#include <string>
#include <utility>

namespace drape {

/// Returns an object of these members.
Json::Value json_object(std::initializer_list<std::pair<const char*, Json::Value>> members);

/// Returns an array of the results of `make` for each item.
template <class Items, class Make>
Json::Value json_array(const Items& items, const Make& make) {
    Json::Value array(Json::arrayValue);
    for (const auto& item : items) array.append(make(item));
    return array;
}

// Returns the JSON text of a value: two spaces of indentation, what fits on one line stays on one line, keys sorted,
// bytes that are not UTF-8 as \xff, doubles with the fewest digits that read back as the same double (JsonCpp's own
// writers have one precision for all numbers). It ends with a newline. Throws OutputError naming the key when a double
// is not finite.
std::string json_text(const Json::Value& value);

// Returns the text for a value inside another one, whose lines begin with so many spaces, without the newline.
std::string json_text(const Json::Value& value, std::size_t indentation);

// Returns the text on one line, without the newline.
std::string json_line(const Json::Value& value);

}  // namespace drape
