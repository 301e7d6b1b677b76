#include "output/json_file.h"

#include <fmt/format.h>
#include <json/reader.h>

#include <memory>

#include "output/atomic_file.h"

namespace drape {

namespace {

struct KindRow {
    const char* expected;
    bool (Json::Value::*fits)() const;
};
// By JsonRule::Kind.
constexpr KindRow kinds[] = {
    {"an object", &Json::Value::isObject},    {"a list", &Json::Value::isArray},
    {"a text", &Json::Value::isString},       {"a number", &Json::Value::isNumeric},
    {"a whole number", &Json::Value::isUInt}, {"true or false", &Json::Value::isBool},
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& at, const char* expected) {
    throw OutputError(fmt::format("'{}': {}: expected {}", file.string(), at.empty() ? "/" : at, expected));
}

// `rest`: of the rule's pointer, below the value at `at`.
void check_below(const Json::Value& value, std::string_view rest, const std::string& at, JsonRule::Kind kind,
                 const std::filesystem::path& file) {
    if (value.isNull()) return;
    if (rest.empty()) {
        const KindRow& row = kinds[static_cast<std::size_t>(kind)];
        if (!(value.*row.fits)()) fail(file, at, row.expected);
        return;
    }
    const std::size_t end = std::min(rest.find('/', 1), rest.size());
    const std::string step(rest.substr(1, end - 1));
    rest.remove_prefix(end);
    const auto go_on = [&](const Json::Value& child, const std::string& name) {
        check_below(child, rest, at + "/" + name, kind, file);
    };
    if (step != "*") {
        if (!value.isObject()) fail(file, at, "an object");
        return go_on(value[step], step);
    }
    if (!value.isObject() && !value.isArray()) fail(file, at, "a list or an object");
    for (auto child = value.begin(); child != value.end(); ++child)
        go_on(*child, value.isArray() ? fmt::format("{}", child.index()) : child.name());
}

}  // namespace

std::optional<Json::Value> parse_json(std::string_view text) {
    Json::Value json;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    try {
        if (reader->parse(text.data(), text.data() + text.size(), &json, nullptr)) return json;
    } catch (const Json::Exception&) {  // nested too deeply
    }
    return std::nullopt;
}

void check_json(const Json::Value& json, std::span<const JsonRule> rules, const std::filesystem::path& file) {
    for (const JsonRule& rule : rules) check_below(json, rule.pointer, "", rule.kind, file);
}

Json::Value read_json(const std::filesystem::path& file, std::span<const JsonRule> rules) {
    const std::optional<Json::Value> json = parse_json(read_file(file));
    if (!json || !json->isObject()) throw OutputError(fmt::format("'{}' is no JSON object", file.string()));
    check_json(*json, rules, file);
    return *json;
}

}  // namespace drape
