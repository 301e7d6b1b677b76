// Reads JSON files, which anybody may have written.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace drape {

// Returns nothing when the text is no JSON, or nested too deeply.
std::optional<Json::Value> parse_json(std::string_view text);

// The type that a value must have if it exists.
struct JsonRule {
    enum class Kind { object, list, text, number, whole_number, boolean };
    std::string_view pointer;  // of the value; `*`: every element of a list, or member of an object
    Kind kind;
};

// Throws OutputError naming the file and the place of the first value that breaks a rule.
void check_json(const Json::Value& json, std::span<const JsonRule> rules, const std::filesystem::path& file);

// Returns a whole file. Throws OutputError, which names it, also when it is no JSON object or breaks a rule.
Json::Value read_json(const std::filesystem::path& file, std::span<const JsonRule> rules);

}  // namespace drape
