#include "bench/stability_result.h"

#include <fmt/format.h>
#include <json/value.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/result_json.h"
#include "output/json_text.h"

namespace drape::bench {

namespace {

constexpr std::size_t verdict_count = std::size(verdict_spellings);

std::string text_of(const Json::Value& value, const char* name) { return value[name].asString(); }

Json::Value json_of(const StabilityResult& result) {
    Json::Value value(Json::objectValue);
    value["name"] = result.name;
    value["key"] = result.key;
    value["verdict"] = std::string(spelling(verdict_spellings, result.verdict));
    value["reason"] = result.reason;
    value["garbage"] = result.garbage;
    value["method"] = result.method;
    value["numbers"] = Json::Value(Json::objectValue);
    for (const auto& [name, number] : result.numbers)
        if (std::isfinite(number))
            value["numbers"][name] = number;
        else
            value["numbers"][name] = "infinite";
    return value;
}

/// Of the cases of a kind: "single", "pair", ...
std::string counts_text(const StabilityReport& report, const std::string& kind) {
    std::array<std::size_t, verdict_count> counts{};
    std::size_t all = 0, garbage = 0;
    for (const StabilityResult& result : report.results) {
        if (!result.name.starts_with(kind + "/")) continue;
        ++counts[static_cast<std::size_t>(result.verdict)];
        ++all;
        garbage += !result.garbage.empty();
    }
    if (all == 0) return {};
    std::string text = fmt::format("{:<8}{:>6} runs:", kind, all);
    for (std::size_t k = 0; k < verdict_count; ++k)
        text += fmt::format(" {} {}{}", counts[k], verdict_spellings[k].name, k + 1 < verdict_count ? "," : "");
    return text + fmt::format("; silent garbage: {}\n", garbage);
}

const StabilityResult* find(const StabilityReport& report, const std::string& name) {
    const auto found = std::ranges::find(report.results, name, &StabilityResult::name);
    return found == report.results.end() ? nullptr : &*found;
}

std::string singles_text(const StabilityReport& report) {
    std::string text = fmt::format("{:<24}{:<6}", "alone", "tier");
    for (const SolverMethodName& method : solver_method_names) text += fmt::format("{:<12}", method.name);
    text += "\n";
    bool any = false;
    for (const Extreme& extreme : extremes()) {
        std::string row = fmt::format("{:<24}{:<6}", extreme.name, spelling(tier_spellings, extreme.tier));
        bool has = false;
        for (const SolverMethodName& method : solver_method_names) {
            const StabilityResult* result = find(report, fmt::format("single/{}/{}", extreme.name, method.name));
            row += fmt::format("{:<12}", result ? spelling(verdict_spellings, result->verdict) : "-");
            has = has || result;
        }
        any = any || has;
        if (has) text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
    }
    return any ? text + "\n" : std::string();
}

}  // namespace

std::string stability_line(const StabilityResult& result) { return json_line(json_of(result)); }

std::optional<StabilityResult> parsed_stability(const std::string& line) try {
    const Json::Value value = parsed_line(line);
    if (!value.isObject() || !value.isMember("numbers")) return std::nullopt;
    StabilityResult result{text_of(value, "name"),
                           text_of(value, "key"),
                           Verdict::fails,
                           text_of(value, "reason"),
                           text_of(value, "garbage"),
                           text_of(value, "method"),
                           {}};
    const std::string verdict = text_of(value, "verdict");
    const auto found = std::ranges::find(verdict_spellings, verdict, &Spelling<Verdict>::name);
    if (found == std::end(verdict_spellings)) return std::nullopt;
    result.verdict = found->value;
    for (const std::string& name : value["numbers"].getMemberNames()) {
        const Json::Value& number = value["numbers"][name];
        result.numbers[name] = number.isNumeric() ? number.asDouble() : INFINITY;
    }
    return result;
} catch (const Json::Exception&) {
    return std::nullopt;
}

std::string shortfall(const StabilityCase& each, const StabilityResult& result) {
    if (!result.garbage.empty()) return "silent garbage: " + result.garbage;
    if (each.tier == Tier::refused && result.verdict != Verdict::refuses) return "not refused";
    if (each.tier == Tier::accurate && result.verdict != Verdict::holds)
        return fmt::format("{}: {}", spelling(verdict_spellings, result.verdict), result.reason);
    if (each.tier == Tier::bounded && (result.verdict == Verdict::fails || result.verdict == Verdict::unsettled))
        return fmt::format("{}: {}", spelling(verdict_spellings, result.verdict), result.reason);
    return {};
}

std::string stability_text(const StabilityReport& report) {
    std::string text = fmt::format("drape {} on {}\n\n", report.program, report.device) + singles_text(report);
    for (const char* kind : {"single", "pair", "mix", "random", "soak"}) text += counts_text(report, kind);
    std::string short_of;
    for (std::size_t k = 0; k < report.results.size(); ++k)
        if (const std::string why = shortfall(report.cases[k], report.results[k]); !why.empty())
            short_of += fmt::format("  {} ({}): {}\n", report.results[k].name,
                                    spelling(tier_spellings, report.cases[k].tier), why);
    if (!short_of.empty()) text += "\nshort of their tier:\n" + short_of;
    return text;
}

std::string stability_json(const StabilityReport& report) {
    Json::Value root(Json::objectValue);
    root["program"] = report.program;
    root["device"] = report.device;
    root["base_scene"] = base_scene();
    root["cases"] = Json::Value(Json::arrayValue);
    for (std::size_t k = 0; k < report.results.size(); ++k) {
        Json::Value value = json_of(report.results[k]);
        value["tier"] = std::string(spelling(tier_spellings, report.cases[k].tier));
        value["shortfall"] = shortfall(report.cases[k], report.results[k]);
        value["set"] = Json::Value(Json::arrayValue);
        if (!report.cases[k].random)
            for (const std::string& each : overrides_of(report.cases[k])) value["set"].append(each);
        root["cases"].append(value);
    }
    return json_text(root);
}

std::string stability_csv(const StabilityReport& report) {
    constexpr const char* columns[] = {
        "frames", "substeps_max", "non_finite",        "pins",        "distance",    "energy",      "mass",
        "flight", "stretch",      "stretch_sustained", "stretch_end", "stretch_law", "penetration", "penetration_end",
        "wall_s"};
    std::string text = "name,tier,verdict";
    for (const char* column : columns) text += fmt::format(",{}", column);
    text += "\n";
    for (std::size_t k = 0; k < report.results.size(); ++k) {
        const StabilityResult& result = report.results[k];
        text += fmt::format("\"{}\",{},{}", result.name, spelling(tier_spellings, report.cases[k].tier),
                            spelling(verdict_spellings, result.verdict));
        for (const char* column : columns) {
            const auto found = result.numbers.find(column);
            text += found == result.numbers.end() ? "," : fmt::format(",{:.6g}", found->second);
        }
        text += "\n";
    }
    return text;
}

}  // namespace drape::bench
