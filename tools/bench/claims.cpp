#include "bench/claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "cloth/solver_choice.h"

namespace drape::bench {

namespace {

constexpr double position_floor = 5e-5;  // m; below it single precision is allowed its own error
constexpr double two_digits = 1.05;      // the tables round to two digits

/// A row holds what the prototype keeps on a sheet at the same passes (explicit: 2.6 N, the fewest that soften
/// nothing): RMS stretch, and position error at 0.25 and 0.5 s.
struct TableRow {
    const char* name;
    double stretch, early, late;
};

constexpr TableRow table_rows[] = {
    {"swing/64/relax/1x20", 0.20, 0.16, 0.19},      {"swing/256/relax/1x20", 0.73, 0.27, 0.98},
    {"swing/64/relax/20", 0.012, 1.1e-2, 1.0e-2},   {"swing/256/relax/20", 0.19, 0.15, 0.16},
    {"swing/256/relax/80", 0.012, 1.1e-2, 1.1e-2},  {"swing/64/explicit/167", 4.4e-4, 2e-7, 2e-7},
    {"swing/256/explicit/668", 4.3e-4, 5e-6, 3e-5}, {"drape/64/relax/1x20", 0.21, 0.13, 0.67},
    {"drape/256/relax/1x20", 0.34, 0.15, 0.99},     {"swing/64/line/20", 4.3e-4, 6e-5, 8e-5},
    {"swing/256/line/20", 4.3e-4, 6e-5, 7e-5},      {"drape/64/line/20", 3.3e-3, 2e-3, 1.4e-2},
    {"drape/64/relax/20", 0.027, 0.063, 0.12},      {"drape/256/relax/20", 0.19, 0.13, 0.70},
    {"drape/256/relax/80", 0.030, 0.071, 0.13},     {"drape/64/explicit/167", 1.8e-3, 6e-7, 3e-4},
    {"drape/256/explicit/668", 1.9e-3, 1e-5, 1e-3}};

/// A limit of every case whose name starts so, up to a number of substeps.
struct GeneralLimit {
    const char* prefix;
    std::uint32_t most_substeps;
    const char* metric;
    double limit;
};

// Damped flight is exact but for rounding where the method solves it exactly; BDF2 (line) does not.
constexpr GeneralLimit general_limits[] = {
    {"free fall/2/relax/", 16, "position_relative", 1e-5},
    {"free fall/2/relax/", 256, "position_relative", 1e-4},
    {"free fall/2/explicit/", 16, "position_relative", 1e-5},
    {"free fall/2/explicit/", 256, "position_relative", 1e-4},
    {"ballistic/", 16, "position_relative", 1e-5},
    {"ballistic/", 256, "position_relative", 1e-4},
    {"incline slide/", 64, "distance_error", 1e-3},
    {"incline stick/", 64, "distance_error", 1e-6},
    {"momentum/", 1000, "momentum_drift", 1e-6},
    {"column law/128/", 1000, "law_error", 0.01},
    {"column law/64/", 1000, "law_error", 0.02},
    {"column law/", 1000, "law_error", 0.07},
    {"catenary/64/relax/1x20", 1, "position_rms_inextensible", 6.5e-2 * two_digits},
    {"catenary/64/relax/20", 20, "position_rms_inextensible", 5.6e-3 * two_digits},
    {"catenary/64/relax/80", 80, "position_rms_inextensible", 3.9e-4 * two_digits},
    {"catenary/64/line/4", 4, "position_rms_inextensible", 2.5e-4 * two_digits},
    {"catenary/64/explicit/", 1000, "position_rms_inextensible", 2.3e-4 * two_digits},
    {"cantilever", 1000000, "ratio_error", 0.1}};

void add_check(const CaseResult& result, const char* metric, double limit, std::vector<LimitCheck>& checks) {
    if (const auto value = result.metric(metric)) checks.push_back({result.name, metric, limit, *value});
}

using Group = std::map<std::string, std::vector<const CaseResult*>>;  ///< results by family

Soonest soonest_of(const std::vector<const CaseResult*>& results, const Target& target) {
    Soonest best{results[0]->problem, results[0]->size, target.metric, target.limit, results[0]->family()};
    for (const CaseResult* result : results) {
        const std::optional<double> measured = result->metric(target.metric);
        if (!measured || *measured > target.limit) continue;
        if (!best.name.empty() && result->passes >= best.passes) continue;
        best.name = result->name;
        best.milliseconds = case_milliseconds(*result);
        best.passes = result->passes;
        best.measured = *measured;
    }
    return best;
}

/// Only the clock on the wall sees what `auto` does again, so its rivals are held against the same clock.
double wall_milliseconds(const CaseResult& result) {
    return result.wall.median > 0 ? result.wall.median : result.device.median;
}

double variable_of(const OrderClaim& claim, const CaseResult& result) {
    return claim.variable == OrderClaim::Variable::size ? result.size : result.substeps;
}

/// Variable and value of the cases that a claim is about, by growing variable.
std::vector<std::array<double, 2>> points_of(const OrderClaim& claim, std::span<const CaseResult> results) {
    std::map<double, const CaseResult*> chosen;
    for (const CaseResult& result : results) {
        const std::optional<double> value = result.metric(claim.metric);
        if (result.problem != claim.problem || result.family() != claim.family || !value) continue;
        if (claim.variable != OrderClaim::Variable::size && result.size != claim.size) continue;
        if (variable_of(claim, result) < claim.least_variable) continue;
        if (!(std::abs(*value) >= claim.floor && std::abs(*value) <= claim.ceiling)) continue;
        const CaseResult*& best = chosen[variable_of(claim, result)];
        if (!best || result.substeps > best->substeps) best = &result;
    }
    std::vector<std::array<double, 2>> points;
    for (const auto& [variable, result] : chosen) points.push_back({variable, result->metrics.at(claim.metric)});
    return points;
}

}  // namespace

std::set<std::string> doubtful_times(std::span<const CaseResult> results) {
    constexpr double widest_spread = 0.3, faster = 0.8;
    std::set<std::string> names;
    for (const CaseResult& result : results) {
        if (result.diverged) continue;
        bool doubtful = case_time(result).spread > widest_spread;
        for (const CaseResult& other : results)
            doubtful |= !other.diverged && other.problem == result.problem && other.size == result.size &&
                        other.family() == result.family() && other.passes > result.passes &&
                        case_milliseconds(other) < faster * case_milliseconds(result);
        if (doubtful) names.insert(result.name);
    }
    return names;
}

std::vector<LimitCheck> check_limits(std::span<const CaseResult> results) {
    std::vector<LimitCheck> checks;
    for (const CaseResult& result : results) {
        for (const TableRow& row : table_rows) {
            if (result.name != row.name) continue;
            add_check(result, "stretch_rms", row.stretch * two_digits, checks);
            add_check(result, "position_rms_0.25", std::max(row.early * two_digits, position_floor), checks);
            add_check(result, "position_rms_0.5", std::max(row.late * two_digits, position_floor), checks);
        }
        const auto applies = [&](const GeneralLimit& limit) {
            return result.name.starts_with(limit.prefix) && result.substeps <= limit.most_substeps;
        };
        // The first that applies is the strictest of its kind.
        const auto limit = std::ranges::find_if(general_limits, applies);
        if (limit != std::end(general_limits)) add_check(result, limit->metric, limit->limit, checks);
    }
    return checks;
}

std::vector<AutoRatio> auto_ratios(std::span<const CaseResult> results) {
    std::vector<AutoRatio> ratios;
    for (const CaseResult& chosen : results) {
        if (chosen.method != SolverMethod::automatic) continue;
        AutoRatio ratio{chosen.problem,
                        chosen.size,
                        chosen.metric("tolerance").value_or(default_tolerance),
                        chosen.diverged ? INFINITY : chosen.metrics.at("worst_stretch_error"),
                        wall_milliseconds(chosen),
                        {},
                        INFINITY};
        for (const CaseResult& other : results) {
            if (other.problem != chosen.problem || other.size != chosen.size || other.method == chosen.method) continue;
            if (other.diverged || other.metrics.at("worst_stretch_error") > ratio.tolerance) continue;
            if (wall_milliseconds(other) >= ratio.best_milliseconds) continue;
            ratio.best = other.name;
            ratio.best_milliseconds = wall_milliseconds(other);
        }
        ratios.push_back(ratio);
    }
    return ratios;
}

std::vector<Soonest> find_soonest(std::span<const CaseResult> results,
                                  const std::map<std::string, std::vector<Target>>& targets) {
    std::map<std::tuple<std::string, std::uint32_t>, Group> groups;
    for (const CaseResult& result : results)
        if (!result.diverged && targets.contains(result.problem))
            groups[{result.problem, result.size}][result.family()].push_back(&result);
    std::vector<Soonest> all;
    for (const auto& [place, families] : groups)
        for (const Target& target : targets.at(std::get<0>(place))) {
            const std::size_t first = all.size();
            for (const auto& [family, members] : families) all.push_back(soonest_of(members, target));
            const auto relax = std::find_if(
                all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                [](const Soonest& s) { return s.family == named(SolverMethod::relax).name && !s.name.empty(); });
            if (relax == all.end()) continue;
            const double milliseconds = relax->milliseconds, passes = relax->passes;
            for (std::size_t k = first; k < all.size(); ++k) {
                if (all[k].name.empty()) continue;
                all[k].time_ratio = all[k].milliseconds > 0 ? milliseconds / all[k].milliseconds : 0;
                all[k].passes_ratio = all[k].passes > 0 ? passes / all[k].passes : 0;
            }
        }
    return all;
}

std::optional<double> log_slope(std::span<const std::array<double, 2>> points) {
    double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (const auto& [x, y] : points) {
        if (!(x > 0 && y > 0)) continue;
        const double u = std::log(x), v = std::log(y);
        ++n;
        sum_x += u;
        sum_y += v;
        sum_xx += u * u;
        sum_xy += u * v;
    }
    const double spread = n * sum_xx - sum_x * sum_x;
    if (n < 2 || spread <= 1e-12 * n * sum_xx) return std::nullopt;
    return (n * sum_xy - sum_x * sum_y) / spread;
}

std::vector<std::array<double, 2>> differences(std::span<const std::array<double, 2>> points) {
    std::vector<std::array<double, 2>> result;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
        result.push_back({points[k][0], std::abs(points[k][1] - points[k + 1][1])});
    return result;
}

std::optional<std::uint32_t> next_count(std::vector<SweepPoint> points) {
    std::ranges::sort(points, {}, &SweepPoint::count);
    const auto first = std::ranges::find(points, true, &SweepPoint::keeps);
    if (first == points.end()) return std::nullopt;
    const std::uint32_t high = first->count, low = first == points.begin() ? 0 : std::prev(first)->count;
    if (high - low <= std::max(1u, high / 50)) return std::nullopt;
    return low + (high - low) / 2;
}

std::vector<OrderFit> fit_orders(std::span<const OrderClaim> claims, std::span<const CaseResult> results) {
    std::vector<OrderFit> fits;
    for (const OrderClaim& claim : claims) {
        OrderFit fit{claim, points_of(claim, results), 0, false};
        if (fit.points.size() < 3) continue;
        if (claim.kind == OrderClaim::Kind::differences) fit.points = differences(fit.points);
        const std::optional<double> slope = log_slope(fit.points);
        if (!slope) continue;
        fit.slope = *slope;
        fit.met = std::abs(fit.slope - claim.expected) <= claim.tolerance;
        fits.push_back(std::move(fit));
    }
    return fits;
}

}  // namespace drape::bench
