#include "bench/fit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace drape::bench {

namespace {

double variable_of(const OrderClaim& claim, const CaseResult& result) {
    switch (claim.variable) {
        case OrderClaim::Variable::substeps:
            return result.substeps;
        case OrderClaim::Variable::iterations:
            return result.iterations;
        case OrderClaim::Variable::size:
            break;
    }
    return result.size;
}

/// Variable and value of the cases that a claim is about, by growing variable.
std::vector<std::array<double, 2>> points_of(const OrderClaim& claim, std::span<const CaseResult> results) {
    std::map<double, const CaseResult*> chosen;
    for (const CaseResult& result : results) {
        const auto metric = result.metrics.find(claim.metric);
        if (result.problem != claim.problem || result.family() != claim.family || metric == result.metrics.end())
            continue;
        if (claim.variable != OrderClaim::Variable::size && result.size != claim.size) continue;
        if (variable_of(claim, result) < claim.least_variable) continue;
        if (!(std::abs(metric->second) >= claim.floor && std::abs(metric->second) <= claim.ceiling)) continue;
        const CaseResult*& best = chosen[variable_of(claim, result)];
        if (!best || result.substeps > best->substeps) best = &result;
    }
    std::vector<std::array<double, 2>> points;
    for (const auto& [variable, result] : chosen) points.push_back({variable, result->metrics.at(claim.metric)});
    return points;
}

}  // namespace

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
