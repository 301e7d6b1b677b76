#include <fmt/format.h>

#include <map>

#include "bench/stability_result.h"
#include "plot/plot.h"

namespace drape::bench {

namespace {

struct Look {
    const char *colour, *letter;
};
/// By Verdict; of Okabe and Ito's colours, which the colour-blind tell apart.
constexpr Look looks[] = {{"#009E73", ""}, {"#56B4E9", ""}, {"#E69F00", "r"}, {"#CC79A7", "u"}, {"#000000", "x"}};
static_assert(std::size(looks) == std::size(verdict_spellings));
constexpr double cell = 11, left = 150, top = 150;

std::string rectangle(double x, double y, const Look& look, const std::string& title) {
    std::string text =
        fmt::format("<g><title>{}</title><rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
                    title, x, y, cell - 1, cell - 1, look.colour);
    if (*look.letter)
        text += plot::svg_text(x + 0.5 * (cell - 1), y + 0.8 * cell, look.letter,
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
    for (std::size_t k = 0; k < shown.size(); ++k) place[shown[k]] = cell * static_cast<double>(k);
    const double side = cell * static_cast<double>(shown.size());
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
        if (each.method != method || each.schedule != Schedule::automatic || !(is_alone || is_pair)) continue;
        const auto x = place.find(each.extremes.front()), y = place.find(each.extremes.back());
        if (x == place.end() || y == place.end()) continue;
        const StabilityResult& result = report.results[k];
        text += rectangle(left + x->second, top + y->second, looks[static_cast<std::size_t>(result.verdict)],
                          fmt::format("{}: {}", each.name, spelling(verdict_spellings, result.verdict)));
    }
    return text + "</svg>\n";
}

}  // namespace drape::bench
