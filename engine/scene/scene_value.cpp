#include "scene/scene_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace drape {
namespace {

std::string integer_schema(std::uint32_t low, std::uint32_t high) {
    return fmt::format("\"type\": \"integer\", \"minimum\": {}, \"maximum\": {}", low, high);
}

std::string array_schema(const std::string& item, std::size_t count) {
    return fmt::format("\"type\": \"array\", \"items\": {{{}}}, \"minItems\": {}, \"maxItems\": {}", item, count,
                       count);
}

template <class T>
std::string written(const T& value) {
    return fmt::format("{}", value);  // gives the fewest digits that read back as the same number
}

}  // namespace

std::string quoted(std::string_view text) {
    std::string json = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') json += '\\';
        json += c;
    }
    return json + '"';
}

std::string reference_schema(const Definition& definition) {
    return fmt::format("\"$ref\": \"#/definitions/{}\"", definition.name);
}

Value<double> number(const Range& range) {
    return {{range.schema(), range.words()},
            [range](const SceneNode& node, double& field) { return node.read(field, range); },
            written<double>};
}

Value<std::uint32_t> integer(std::uint32_t low, std::uint32_t high) {
    return {{integer_schema(low, high), fmt::format("integer, {} to {}", low, high)},
            [low, high](const SceneNode& node, std::uint32_t& field) { return node.read(field, low, high); },
            written<std::uint32_t>};
}

Value<std::uint32_t> one_of(std::vector<std::uint32_t> allowed) {
    const std::string words = fmt::format("{}", fmt::join(allowed, " or "));
    return {{fmt::format("\"enum\": [{}]", fmt::join(allowed, ", ")), words},
            [allowed, words](const SceneNode& node, std::uint32_t& field) {
                for (const std::uint32_t number : allowed)
                    if (node && node.value()->isNumeric() && node.value()->asDouble() == number) {
                        field = number;
                        return true;
                    }
                return !node || node.fail_expected(words);
            },
            written<std::uint32_t>};
}

Value<std::array<double, 2>> two_numbers(const Range& range) {
    return {{array_schema(range.schema(), 2), "array of 2 numbers" + range.words().substr(6)},
            [range](const SceneNode& node, std::array<double, 2>& field) {
                return node.read(field, "an array of 2 numbers", range);
            },
            written<std::array<double, 2>>};
}

Value<std::array<std::uint32_t, 2>> two_integers(std::uint32_t low, std::uint32_t high) {
    return {{array_schema(integer_schema(low, high), 2), fmt::format("array of 2 integers, {} to {}", low, high)},
            [low, high](const SceneNode& node, std::array<std::uint32_t, 2>& field) {
                if (!node.open_array("an array of 2 integers", 2, 2)) return !node;
                const bool has_first = node.element(0).read(field[0], low, high);
                return node.element(1).read(field[1], low, high) && has_first;
            },
            written<std::array<std::uint32_t, 2>>};
}

Value<Vec3> three_numbers(const Range& range) {
    return {{array_schema(range.schema(), 3), "array of 3 numbers" + range.words().substr(6)},
            [range](const SceneNode& node, Vec3& field) { return node.read(field, range); },
            written<Vec3>};
}

Value<Vec3> unit_vector() {
    Value<Vec3> value = three_numbers(any_number);
    value.read = [](const SceneNode& node, Vec3& field) { return node.read_direction(field); };
    return value;
}

Value<bool> boolean() {
    return {{"\"type\": \"boolean\"", "`true` or `false`"},
            [](const SceneNode& node, bool& field) { return node.read(field); },
            written<bool>};
}

Value<std::string> text() {
    return {{"\"type\": \"string\"", "string"},
            [](const SceneNode& node, std::string& field) { return node.read(field); },
            [](const std::string& field) { return drape::quoted(field); }};  // this is not std::quoted
}

bool Members::fit(std::initializer_list<std::string_view> keys) const {
    return std::none_of(keys.begin(), keys.end(),
                        [&](std::string_view key) { return std::ranges::find(unfit_, key) != unfit_.end(); });
}

}  // namespace drape
