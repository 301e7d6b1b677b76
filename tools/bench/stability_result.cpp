#include "bench/stability_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "plot/plot.h"

namespace drape::bench {

namespace {

constexpr std::size_t verdict_count = std::size(verdict_spellings);

/// A line on the cases of a kind: "single", "pair", ...
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

std::string shortfall(const StabilityCase& each, const StabilityResult& result) {
    if (!result.garbage.empty()) return "silent garbage: " + result.garbage;
    if (each.tier == Tier::refused && result.verdict != Verdict::refuses) return "not refused";
    const bool fails = result.verdict == Verdict::fails || result.verdict == Verdict::unsettled;
    if (each.tier == Tier::accurate ? result.verdict == Verdict::holds : each.tier == Tier::refused || !fails)
        return {};
    return fmt::format("{}: {}", spelling(verdict_spellings, result.verdict), result.reason);
}

std::string stability_text(const StabilityReport& report) {
    std::string text = report.text() + "\n\n" + singles_text(report);
    for (const char* kind : {"single", "pair", "mix", "random", "soak"}) text += counts_text(report, kind);
    std::string short_of;
    for (std::size_t k = 0; k < report.results.size(); ++k)
        if (const std::string why = shortfall(report.cases[k], report.results[k]); !why.empty())
            short_of += fmt::format("  {} ({}): {}\n", report.results[k].name,
                                    spelling(tier_spellings, report.cases[k].tier), why);
    if (!short_of.empty()) text += "\nshort of their tier:\n" + short_of;
    return text;
}

/// Everything about the cases as rows of JSON.
std::vector<Json::Value> rows_of(const StabilityReport& report) {
    std::vector<Json::Value> rows;
    for (std::size_t k = 0; k < report.results.size(); ++k) {
        const StabilityCase& each = report.cases[k];
        Json::Value& row = rows.emplace_back(json_of(report.results[k]));
        row["tier"] = std::string(spelling(tier_spellings, each.tier));
        row["shortfall"] = shortfall(each, report.results[k]);
        row["set"] = member_json(each.random ? std::vector<std::string>() : overrides_of(each));
    }
    return rows;
}

std::string stability_json(const StabilityReport& report) {
    Json::Value root = report.json("drape bench stability 1");
    root["base_scene"] = base_scene();
    root["cases"] = json_array(rows_of(report), [](const Json::Value& row) { return row; });
    return json_text(root);
}

std::string stability_csv(const StabilityReport& report) {
    std::vector<Json::Value> rows = rows_of(report);
    for (Json::Value& row : rows)
        for (const std::string& name : row["numbers"].getMemberNames()) row[name] = row["numbers"][name];
    return csv_table(rows, {"name", "tier", "verdict", "frames", "substeps_max", "non_finite", "pins", "distance",
                            "energy", "mass", "flight", "stretch", "stretch_sustained", "stretch_end", "stretch_law",
                            "penetration", "penetration_end", "wall_s"});
}

namespace {

struct Look {
    const char *colour, *letter;
};
/// By Verdict; of Okabe and Ito's colours, which the colour-blind tell apart.
constexpr Look looks[] = {{"#009E73", ""}, {"#56B4E9", ""}, {"#E69F00", "r"}, {"#CC79A7", "u"}, {"#000000", "x"}};
static_assert(std::size(looks) == std::size(verdict_spellings));
constexpr double square = 11, left = 150, top = 150;

std::string rectangle(double x, double y, const Look& look, const std::string& title) {
    std::string text =
        fmt::format("<g><title>{}</title><rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
                    title, x, y, square - 1, square - 1, look.colour);
    if (*look.letter)
        text += plot::svg_text(x + 0.5 * (square - 1), y + 0.8 * square, look.letter,
                               "text-anchor=\"middle\" fill=\"#ffffff\"");
    return text + "</g>\n";
}

std::string legend(double x) {
    std::string text;
    for (std::size_t k = 0; k < std::size(looks); ++k) {
        const double y = 20 + 16 * static_cast<double>(k);
        text += rectangle(x, y, looks[k], std::string(verdict_spellings[k].name));
        text += plot::svg_text(x + 16, y + 9, std::string(verdict_spellings[k].name));
    }
    return text;
}

}  // namespace

std::string stability_map(const StabilityReport& report, SolverMethod method) {
    std::vector<std::size_t> shown;  // refused ones have no pairs
    for (std::size_t k = 0; k < extremes().size(); ++k)
        if (extremes()[k].tier != Tier::refused) shown.push_back(k);
    std::map<std::size_t, double> place;
    for (std::size_t k = 0; k < shown.size(); ++k) place[shown[k]] = square * static_cast<double>(k);
    const double side = square * static_cast<double>(shown.size());
    const std::string title = fmt::format("Extremes alone and in pairs, method {}", named(method).name);
    std::string text = plot::svg_begin(left + side + 20, top + side + 20, title, 9) +
                       plot::svg_text(16, 20, title, "font-size=\"14\"");
    text += legend(16 + left + 0.6 * side);
    for (const auto& [index, at] : place) {
        text += plot::svg_text(left - 4, top + at + 9, extremes()[index].name, "text-anchor=\"end\"");
        text += fmt::format("<text transform=\"translate({} {}) rotate(-90)\">{}</text>\n", left + at + 9, top + at - 4,
                            extremes()[index].name);
    }
    for (std::size_t k = 0; k < report.results.size(); ++k) {
        const StabilityCase& each = report.cases[k];
        const bool is_alone = each.name.starts_with("single/"), is_pair = each.name.starts_with("pair/");
        if (each.method != method || !each.kernels.is_automatic() || !(is_alone || is_pair)) continue;
        const auto x = place.find(each.extremes.front()), y = place.find(each.extremes.back());
        if (x == place.end() || y == place.end()) continue;
        const StabilityResult& result = report.results[k];
        text += rectangle(left + x->second, top + y->second, looks[static_cast<std::size_t>(result.verdict)],
                          fmt::format("{}: {}", each.name, spelling(verdict_spellings, result.verdict)));
    }
    return text + "</svg>\n";
}

}  // namespace drape::bench
