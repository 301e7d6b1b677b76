#include "bench/result_json.h"

namespace drape::bench {

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
    value["device_ms_per_frame"] = result.device_ms;
    value["device_ms_low"] = result.device_ms_low;
    value["device_ms_high"] = result.device_ms_high;
    value["wall_ms_per_frame"] = result.wall_ms;
    value["seconds"] = result.seconds;
    for (const auto& [name, number] : result.metrics) metrics[name] = number;
    value["metrics"] = metrics;
    return value;
}

std::optional<CaseResult> result_of(const Json::Value& value) {
    if (!value.isObject() || !value["metrics"].isObject()) return std::nullopt;
    for (const char* member :
         {"name", "key", "problem", "size", "method", "substeps", "iterations", "diverged", "passes_per_frame",
          "stiffness_share", "device_ms_per_frame", "device_ms_low", "device_ms_high", "wall_ms_per_frame", "seconds"})
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
    result.device_ms = value["device_ms_per_frame"].asDouble();
    result.device_ms_low = value["device_ms_low"].asDouble();
    result.device_ms_high = value["device_ms_high"].asDouble();
    result.wall_ms = value["wall_ms_per_frame"].asDouble();
    result.seconds = value["seconds"].asDouble();
    for (const std::string& name : value["metrics"].getMemberNames())
        result.metrics[name] = value["metrics"][name].asDouble();
    return result;
}

}  // namespace drape::bench
