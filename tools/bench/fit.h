// Orders of convergence by least squares.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/problem.h"

namespace drape::bench {

/// Slope of the least-squares line through (log x, log y) of points whose x and y are positive; nothing with
/// fewer than two different x.
std::optional<double> log_slope(std::span<const std::array<double, 2>> points);

/// Neighbours' differences of values at growing x: (x_k, |y_k - y_(k+1)|). Where y = limit + c x^p with
/// doubling x, the log slope of these is p.
std::vector<std::array<double, 2>> differences(std::span<const std::array<double, 2>> points);

struct OrderFit {
    OrderClaim claim;
    std::vector<std::array<double, 2>> points;  ///< that the slope goes through: variable, value
    double slope = 0;
    bool met = false;
};

/// Fits every claim that the results have at least three points for (two differences). Sizes are the variable
/// of the cases with the most substeps of each size.
std::vector<OrderFit> fit_orders(std::span<const OrderClaim> claims, std::span<const CaseResult> results);

}  // namespace drape::bench
