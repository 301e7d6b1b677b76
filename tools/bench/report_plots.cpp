// The plots of an accuracy report.
#include <fmt/format.h>

#include <algorithm>

#include "bench/report.h"

namespace drape::bench {

namespace {

using Results = std::vector<const CaseResult*>;
using Coordinate = double (*)(const CaseResult&);

double substeps_of(const CaseResult& result) { return result.substeps; }
double size_of(const CaseResult& result) { return result.size; }
double passes_of(const CaseResult& result) { return result.passes; }

/// A curve per family, one point per `order` and joined in it; the last of several results counts, which for sizes is
/// the finest setting. Cases whose time is `doubtful` are marked.
std::vector<plot::Curve> curves_of(const Results& results, const std::string& metric, Coordinate x, Coordinate order,
                                   const std::set<std::string>& doubtful = {}) {
    std::map<std::string, std::map<double, const CaseResult*>> families;
    for (const CaseResult* result : results)
        if (result->metrics.contains(metric)) families[result->family()][order(*result)] = result;
    std::vector<plot::Curve> curves;
    for (const auto& [family, members] : families) {
        plot::Curve& curve = curves.emplace_back(plot::Curve{family});
        for (const auto& [place, result] : members) {
            curve.points.push_back({x(*result), result->metrics.at(metric)});
            curve.doubtful.push_back(doubtful.contains(result->name));
        }
    }
    return curves;
}

void add(const std::string& problem, const std::string& rest, plot::Plot plot, plot::Plots& plots) {
    const bool is_worth_it = std::ranges::any_of(plot.curves, [](const plot::Curve& curve) {
        return std::ranges::count_if(curve.points, [](const auto& p) { return p[0] > 0 && p[1] > 0; }) >= 2;
    });
    if (!is_worth_it) return;
    std::string name = fmt::format("{}_{}.svg", problem, rest);
    std::ranges::replace(name, ' ', '_');
    plots.emplace_back(name, std::move(plot));
}

std::string title_of(const Problem& problem, std::uint32_t size) {
    if (problem.of_user) return problem.title;
    if (problem.name == "strip") return fmt::format("{}, {} links long", problem.title, size);
    return fmt::format("{}, {} x {} links", problem.title, size, size);
}

void add_work_plots(const Problem& problem, std::uint32_t size, const Results& results,
                    const std::set<std::string>& doubtful, plot::Plots& plots) {
    struct Error {
        const char *metric, *name, *label;
        double target;
    };
    const Error errors[] = {{"position_rms", "position", "RMS position error, m", 1e-3},
                            {"stretch_error", "stretch", "RMS stretch error, mean over frames, m/m", 0.01},
                            {"worst_stretch_error", "worst_stretch", "RMS stretch error, worst frame, m/m", 0.01}};
    struct Work {
        const char *name, *label;
        Coordinate x;
        std::set<std::string> doubtful;
    };
    const Work works[] = {{"time", "simulation time per frame, ms", case_milliseconds, doubtful},
                          {"passes", "passes over all particles per frame, count", passes_of, {}}};
    for (const Error& error : errors)
        for (const Work& work : works) {
            plot::Plot plot{title_of(problem, size),
                            work.label,
                            error.label,
                            curves_of(results, error.metric, work.x, passes_of, work.doubtful),
                            {-1, -2},
                            {{fmt::format("{:g}", error.target), error.target}}};
            const auto own =
                std::ranges::find_if(results, [](const auto* r) { return r->metrics.contains("reference_error"); });
            if (problem.of_user && error.metric == problem.metric && own != results.end())
                plot.levels.push_back({"the reference's own error", (*own)->metrics.at("reference_error")});
            add(problem.name, fmt::format("{}_{}_{}", size, error.name, work.name), std::move(plot), plots);
        }
}

void add_order_plot(const Problem& problem, const Results& results, plot::Plots& plots) {
    const bool by_size = std::ranges::any_of(results, [&](const auto* r) { return r->size != results[0]->size; });
    const Coordinate x = by_size ? size_of : substeps_of;
    add(problem.name, by_size ? "size" : "substeps",
        {problem.title,
         by_size ? "links N, count" : "substeps per frame, count",
         fmt::format("{}, {}", problem.metric, problem.unit),
         curves_of(results, problem.metric, x, x),
         {-1, -2}},
        plots);
}

}  // namespace

plot::Plots report_plots(const Report& report, const std::vector<Problem>& problems) {
    plot::Plots plots;
    for (const Problem& problem : problems) {
        std::map<std::uint32_t, Results> by_size;
        Results all;
        for (const CaseResult& result : report.results) {
            if (result.problem != problem.name) continue;
            by_size[result.size].push_back(&result);
            all.push_back(&result);
        }
        if (!problem.timed && !all.empty()) add_order_plot(problem, all, plots);
        if (!problem.timed) continue;
        for (const auto& [size, results] : by_size) add_work_plots(problem, size, results, report.doubtful, plots);
    }
    return plots;
}

}  // namespace drape::bench
