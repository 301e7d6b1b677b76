// The benchmark's results for people and programs: a table, JSON, CSV, plots.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench_run.h"
#include "bench/claims.h"
#include "plot/plot.h"

namespace drape::bench {

struct Report : ReportHead {
    std::vector<CaseResult> results{};
    std::map<std::string, std::string> notes{};            ///< by problem: what it is compared with
    std::map<std::string, std::vector<Target>> targets{};  ///< by problem: errors wanted soonest
    std::set<std::string> doubtful{};                      ///< cases whose time is not to be trusted
    std::vector<OrderFit> orders{};
    std::vector<LimitCheck> limits{};
    std::vector<Soonest> soonest{};
    std::vector<AutoRatio> auto_ratios{};
};

/// Orders, limits and ratios of the results that the report holds.
void evaluate(Report& report);

/// How many orders and limits are not met and on how many scenes `auto` did not keep its tolerance.
std::size_t missed_count(const Report& report);

std::string report_text(const Report& report, const std::vector<Problem>& problems);
std::string report_json(const Report& report);
/// A row per case; a column per metric, empty where a case has none.
std::string report_csv(const Report& report);
/// File names and plots: per timed problem and size the errors against time and against passes; for the
/// others the error against substeps or size. Only of what has two points or more.
plot::Plots report_plots(const Report& report, const std::vector<Problem>& problems);

}  // namespace drape::bench
