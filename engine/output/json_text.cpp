#include "output/json_text.h"

#include <fmt/format.h>
#include <json/writer.h>

#include <charconv>
#include <cmath>

#include "base/output_error.h"
#include "base/printable_text.h"

namespace drape {

namespace {

constexpr size_t line_length = 110;

std::string number_text(double value, const std::string& pointer) {
    if (!std::isfinite(value)) throw OutputError(fmt::format("JSON: {} is not finite ({})", pointer, value));
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return std::string(text, end);
}

std::string quoted(const std::string& text) {
    return Json::valueToQuotedString(printable(text, Escaped::not_utf8).c_str());
}

std::string leaf_text(const Json::Value& value, const std::string& pointer) {
    switch (value.type()) {
        case Json::nullValue:
            return "null";
        case Json::booleanValue:
            return Json::valueToString(value.asBool());
        case Json::intValue:
            return Json::valueToString(value.asLargestInt());
        case Json::uintValue:
            return Json::valueToString(value.asLargestUInt());
        case Json::realValue:
            return number_text(value.asDouble(), pointer);
        default:
            return quoted(value.asString());
    }
}

// Calls visit(prefix, child, child's pointer) for every child; prefix is the quoted key and colon in an object.
template <class Visit>
void for_each_child(const Json::Value& value, const std::string& pointer, const Visit& visit) {
    for (auto child = value.begin(); child != value.end(); ++child) {
        if (value.isArray()) {
            visit(std::string(), *child, fmt::format("{}/{}", pointer, child.index()));
        } else {
            const std::string key = child.name();
            visit(quoted(key) + ": ", *child, fmt::format("{}/{}", pointer, key));
        }
    }
}

std::string one_line(const Json::Value& value, const std::string& pointer) {
    if (!value.isArray() && !value.isObject()) return leaf_text(value, pointer);
    std::string text;
    for_each_child(value, pointer, [&](const std::string& prefix, const Json::Value& child, const std::string& at) {
        text += (text.empty() ? "" : ", ") + prefix + one_line(child, at);
    });
    return value.isArray() ? fmt::format("[{}]", text) : fmt::format("{{{}}}", text);
}

void append_value(std::string& text, const Json::Value& value, const std::string& pointer, size_t indentation,
                  size_t column) {
    const std::string line = one_line(value, pointer);
    const bool is_root = indentation == 0;
    if (value.empty() || (!value.isArray() && !value.isObject()) || (!is_root && column + line.size() <= line_length)) {
        text += line;
        return;
    }
    const std::string margin(indentation + 2, ' ');
    text += value.isArray() ? "[" : "{";
    bool is_first = true;
    for_each_child(value, pointer, [&](const std::string& prefix, const Json::Value& child, const std::string& at) {
        text += (is_first ? "\n" : ",\n") + margin + prefix;
        append_value(text, child, at, margin.size(), margin.size() + prefix.size());
        is_first = false;
    });
    text += fmt::format("\n{}{}", margin.substr(2), value.isArray() ? "]" : "}");
}

}  // namespace

Json::Value json_object(std::initializer_list<std::pair<const char*, Json::Value>> members) {
    Json::Value object(Json::objectValue);
    for (const auto& [name, value] : members) object[name] = value;
    return object;
}

std::string json_text(const Json::Value& value) {
    std::string text;
    append_value(text, value, "", 0, 0);
    return text + "\n";
}

std::string json_text(const Json::Value& value, std::size_t indentation) {
    std::string text;
    append_value(text, value, "", indentation, indentation);
    return text;
}

std::string json_line(const Json::Value& value) { return one_line(value, ""); }

}  // namespace drape
