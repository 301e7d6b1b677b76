#include "bench/result_json.h"

#include <json/json.h>

#include <algorithm>
#include <memory>

namespace drape::bench {

Json::Value parsed_line(const std::string& line) {
    Json::CharReaderBuilder builder;
    builder["failIfExtra"] = true;
    const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
    Json::Value value;
    std::string errors;
    return reader->parse(line.data(), line.data() + line.size(), &value, &errors) ? value : Json::Value();
}

Json::Value json_of(const CaseResult& result) {
    Json::Value value(Json::objectValue), metrics(Json::objectValue);
    value["name"] = result.name;
    value["key"] = result.key;
    value["problem"] = result.problem;
    value["size"] = result.size;
    value["method"] = std::string(named(result.method).name);
    value["substeps"] = result.substeps;
    value["iterations"] = result.iterations;
    value["diverged"] = result.diverged;
    value["passes_per_frame"] = result.passes;
    value["stiffness_share"] = result.stiffness_share;
    for (const auto& [clock, timing] :
         {std::pair<std::string, const Timing&>("device", result.device), {"wall", result.wall}}) {
        value[clock + "_ms_per_frame"] = timing.median;
        value[clock + "_ms_least"] = timing.least;
        value[clock + "_ms_spread"] = timing.spread;
    }
    value["seconds"] = result.seconds;
    for (const auto& [name, number] : result.metrics) metrics[name] = number;
    value["metrics"] = metrics;
    return value;
}

std::optional<CaseResult> result_of(const Json::Value& value) {
    if (!value.isObject() || !value["metrics"].isObject()) return std::nullopt;
    for (const char* member : {"name", "key", "problem", "size", "method", "substeps", "iterations", "diverged",
                               "passes_per_frame", "stiffness_share", "device_ms_per_frame", "device_ms_least",
                               "device_ms_spread", "wall_ms_per_frame", "wall_ms_least", "wall_ms_spread", "seconds"})
        if (!value.isMember(member)) return std::nullopt;
    CaseResult result;
    result.name = value["name"].asString();
    result.key = value["key"].asString();
    result.problem = value["problem"].asString();
    result.size = value["size"].asUInt();
    const auto method = std::ranges::find(solver_method_names, value["method"].asString(), &SolverMethodName::name);
    if (method == solver_method_names.end()) return std::nullopt;
    result.method = method->method;
    result.substeps = value["substeps"].asUInt();
    result.iterations = value["iterations"].asUInt();
    result.diverged = value["diverged"].asBool();
    result.passes = value["passes_per_frame"].asDouble();
    result.stiffness_share = value["stiffness_share"].asDouble();
    const auto timing = [&](const std::string& clock) {
        return Timing{value[clock + "_ms_per_frame"].asDouble(), value[clock + "_ms_least"].asDouble(),
                      value[clock + "_ms_spread"].asDouble()};
    };
    result.device = timing("device");
    result.wall = timing("wall");
    result.seconds = value["seconds"].asDouble();
    for (const std::string& name : value["metrics"].getMemberNames())
        result.metrics[name] = value["metrics"][name].asDouble();
    return result;
}

}  // namespace drape::bench
