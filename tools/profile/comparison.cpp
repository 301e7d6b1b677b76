#include "profile/comparison.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <map>

#include "output/json_file.h"
#include "profile/profile.h"

namespace drape::profile {

namespace {

constexpr double least_noise = 0.02;

struct Parsed {
    Json::Value context;
    std::vector<std::string> names;  ///< in the file's order
    std::map<std::string, std::vector<double>> samples;
};

Parsed parsed(const std::string& text, const std::string& name) {
    const std::optional<Json::Value> json = parse_json(text);
    if (!json) throw NoProfile(name + ": no JSON");
    const Json::Value& root = *json;
    try {
        if (!root.isObject() || !root["benchmarks"].isArray() || !root["context"].isObject())
            throw NoProfile(name + ": no profile: it needs \"context\" and \"benchmarks\"");
        Parsed result{root["context"], {}, {}};
        for (const Json::Value& entry : root["benchmarks"]) {
            if (entry["run_type"].asString() != "iteration") continue;
            std::vector<double>& samples = result.samples[entry["name"].asString()];
            if (samples.empty()) result.names.push_back(entry["name"].asString());
            samples.push_back(entry["real_time"].asDouble());
        }
        if (result.names.empty()) throw NoProfile(name + ": no profile: nothing was measured");
        return result;
    } catch (const Json::Exception& error) {
        throw NoProfile(fmt::format("{}: no profile: {}", name, error.what()));
    }
}

ComparedRow compared(const std::string& name, const std::vector<double>& before, const std::vector<double>& after) {
    const Statistics a = statistics_of(before), b = statistics_of(after);
    ComparedRow row{name, a.median, b.median, std::max({least_noise, a.spread, b.spread})};
    if (b.median > a.median * (1 + row.noise)) row.verdict = ComparedRow::Verdict::slower;
    if (a.median > b.median * (1 + row.noise)) row.verdict = ComparedRow::Verdict::faster;
    return row;
}

std::string verdict_text(ComparedRow::Verdict verdict) {
    if (verdict == ComparedRow::Verdict::same) return "within noise";
    return verdict == ComparedRow::Verdict::faster ? "faster" : "SLOWER";
}

}  // namespace

bool Comparison::slower() const {
    return std::ranges::any_of(rows,
                               [](const ComparedRow& row) { return row.verdict == ComparedRow::Verdict::slower; });
}

std::string Comparison::text() const {
    std::string text;
    for (const std::string& difference : differences) text += difference + "\n";
    std::size_t width = 8;
    for (const ComparedRow& row : rows) width = std::max(width, row.name.size());
    text += fmt::format("{:<{}}{:>12}{:>12}{:>9}{:>9}\n", "median, ms", width + 2, "before", "after", "ratio", "noise");
    for (const ComparedRow& row : rows)
        text +=
            fmt::format("{:<{}}{:>12.3f}{:>12.3f}{:>9.3f}{:>7.0f} %  {}\n", row.name, width + 2, row.before, row.after,
                        row.before > 0 ? row.after / row.before : 1.0, 100 * row.noise, verdict_text(row.verdict));
    return text;
}

Comparison compare(const std::string& before, const std::string& before_name, const std::string& after,
                   const std::string& after_name) {
    const Parsed a = parsed(before, before_name), b = parsed(after, after_name);
    Comparison comparison;
    for (const char* key : {"scene", "device", "driver", "solver", "kernels", "draws", "by", "executable"})
        if (a.context[key] != b.context[key])
            comparison.differences.push_back(
                fmt::format("{}: {} before, {} after", key, a.context[key].asString(), b.context[key].asString()));
    for (const std::string& name : a.names)
        if (const auto found = b.samples.find(name); found != b.samples.end())
            comparison.rows.push_back(compared(name, a.samples.at(name), found->second));
    return comparison;
}

}  // namespace drape::profile
