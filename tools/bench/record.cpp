#include "bench/record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "output/csv_text.h"

namespace drape::bench {

Json::Value member_json(const Metrics& numbers) {
    Json::Value value(Json::objectValue);
    for (const auto& [name, number] : numbers)
        value[name] = std::isfinite(number) ? Json::Value(number) : Json::Value("infinite");
    return value;
}

Json::Value member_json(SolverMethod method) { return std::string(named(method).name); }

void read_member(const Json::Value& value, std::string& member) {
    if (!value.isString()) Json::throwLogicError("no text");
    member = value.asString();
}

void read_member(const Json::Value& value, Metrics& member) {
    for (const std::string& name : value.getMemberNames())
        member[name] = value[name].isString() ? INFINITY : value[name].asDouble();
}

void read_member(const Json::Value& value, SolverMethod& member) {
    const auto found = std::ranges::find(solver_method_names, value.asString(), &SolverMethodName::name);
    if (found == solver_method_names.end()) Json::throwLogicError("no such method");
    member = found->method;
}

Json::Value points_json(const std::vector<std::array<double, 2>>& points) {
    const auto number = [](double value) { return value; };
    return json_array(points, [&](const auto& point) { return json_array(point, number); });
}

Json::Value parsed_line(const std::string& line) {
    Json::CharReaderBuilder builder;
    builder["failIfExtra"] = true;
    const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
    Json::Value value;
    std::string errors;
    return reader->parse(line.data(), line.data() + line.size(), &value, &errors) ? value : Json::Value();
}

std::string csv_table(const std::vector<Json::Value>& rows, const std::vector<std::string>& columns) {
    const auto field = [](const Json::Value& value) {
        if (value.isNull()) return std::string();
        if (value.isBool()) return std::string(value.asBool() ? "1" : "0");
        return value.isString() ? csv_text(value.asString()) : json_line(value);
    };
    std::string text = fmt::format("{}\n", fmt::join(columns, ","));
    for (const Json::Value& row : rows)
        for (std::size_t k = 0; k < columns.size(); ++k)
            text += field(row[columns[k]]) + (k + 1 < columns.size() ? "," : "\n");
    return text;
}

}  // namespace drape::bench
