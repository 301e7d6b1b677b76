// Which plots a report has.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/report.h"

namespace drape::bench {

namespace {

using Coordinate = double (*)(const CaseResult&);

double substeps_of(const CaseResult& result) { return result.substeps; }
double size_of(const CaseResult& result) { return result.size; }
double passes_of(const CaseResult& result) { return result.passes; }

std::string file_name(const std::string& problem, const std::string& rest) {
    std::string name = problem + "_" + rest + ".svg";
    std::ranges::replace(name, ' ', '_');
    return name;
}

struct Point {
    double x, value;
    bool doubtful;
};

/// A series per family, one point per `order` and joined in it (of a size: the finest setting, which comes last). Cases
/// whose time is `doubtful` are marked.
std::vector<PlotSeries> series_of(const std::vector<const CaseResult*>& results, const std::string& metric,
                                  Coordinate x, Coordinate order, const std::set<std::string>& doubtful = {}) {
    std::map<std::string, std::map<double, Point>> families;
    for (const CaseResult* result : results)
        if (const auto found = result->metrics.find(metric); found != result->metrics.end())
            families[result->family()][order(*result)] = {x(*result), found->second, doubtful.contains(result->name)};
    std::vector<PlotSeries> series;
    for (const auto& [family, points] : families) {
        series.push_back({family, {}});
        for (const auto& [place, point] : points) {
            series.back().points.push_back({point.x, point.value});
            series.back().doubtful.push_back(point.doubtful);
        }
    }
    return series;
}

bool worth_drawing(const LogPlot& plot) {
    return std::ranges::any_of(plot.series, [](const PlotSeries& series) {
        return std::ranges::count_if(series.points, [](const auto& p) { return p[0] > 0 && p[1] > 0; }) >= 2;
    });
}

using Plots = std::vector<std::pair<std::string, LogPlot>>;

/// Below it no error can be told.
void add_reference_level(const std::vector<const CaseResult*>& results, LogPlot& plot) {
    for (const CaseResult* result : results)
        if (const auto found = result->metrics.find("reference_error"); found != result->metrics.end()) {
            plot.levels.push_back({"the reference's own error", found->second});
            return;
        }
}

void add_work_plots(const Problem& problem, std::uint32_t size, const std::vector<const CaseResult*>& results,
                    const std::set<std::string>& doubtful, Plots& plots) {
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
        std::vector<double> slopes;
        bool is_time;
    };
    const Work works[] = {{"time", "simulation time per frame, ms", case_milliseconds, {-1, -2}, true},
                          {"passes", "passes over all particles per frame, count", passes_of, {-1, -2}, false}};
    for (const Error& error : errors)
        for (const Work& work : works) {
            LogPlot plot{
                fmt::format("{}, {} x {} links", problem.title, size, size),
                work.label,
                error.label,
                series_of(results, error.metric, work.x, passes_of, work.is_time ? doubtful : std::set<std::string>()),
                work.slopes,
                {{fmt::format("{:g}", error.target), error.target}}};
            if (problem.of_user) plot.title = problem.title;
            if (problem.of_user && error.metric == problem.metric) add_reference_level(results, plot);
            if (problem.name == "strip") plot.title = fmt::format("{}, {} links long", problem.title, size);
            if (worth_drawing(plot))
                plots.emplace_back(file_name(problem.name, fmt::format("{}_{}_{}", size, error.name, work.name)), plot);
        }
}

void add_order_plot(const Problem& problem, const std::vector<const CaseResult*>& results, Plots& plots) {
    const bool by_size = std::ranges::any_of(results, [&](const CaseResult* r) { return r->size != results[0]->size; });
    const LogPlot plot{
        problem.title,
        by_size ? "links N, count" : "substeps per frame, count",
        fmt::format("{}, {}", problem.metric, problem.unit),
        series_of(results, problem.metric, by_size ? size_of : substeps_of, by_size ? size_of : substeps_of),
        {-1, -2},
        {}};
    if (worth_drawing(plot)) plots.emplace_back(file_name(problem.name, by_size ? "size" : "substeps"), plot);
}

}  // namespace

std::vector<std::pair<std::string, LogPlot>> report_plots(const Report& report, const std::vector<Problem>& problems) {
    Plots plots;
    for (const Problem& problem : problems) {
        std::map<std::uint32_t, std::vector<const CaseResult*>> by_size;
        std::vector<const CaseResult*> all;
        for (const CaseResult& result : report.results) {
            if (result.problem != problem.name) continue;
            by_size[result.size].push_back(&result);
            all.push_back(&result);
        }
        if (all.empty()) continue;
        if (!problem.timed) {
            add_order_plot(problem, all, plots);
            continue;
        }
        for (const auto& [size, results] : by_size) add_work_plots(problem, size, results, report.doubtful, plots);
    }
    return plots;
}

}  // namespace drape::bench
