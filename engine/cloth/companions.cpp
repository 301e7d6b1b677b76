#include "cloth/companions.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// Runs of fewer substeps are so far from all others in contact that their distances tell nothing of those.
constexpr std::uint32_t least_companion = 4;
constexpr double least_order = 0.7, most_order = 3;
/// Companions whose steps are nearer to each other's length than that tell no order.
constexpr double least_apart = 1.8;

}  // namespace

Companions companions_of(const Method& method, std::uint32_t substeps) {
    const std::uint32_t more = (3 * substeps + 1) / 2;
    if (method.trust == Method::Trust::resolves) return {more <= method.most_substeps ? more : 2 * substeps / 3, 0};
    if (substeps == 1) return {more, 0};
    const std::uint32_t companion = std::max(substeps / 4, std::min(least_companion, substeps / 2));
    return {companion, std::max(companion / 2, 1u)};
}

StepRatios step_ratios(const Companions& with, std::uint32_t substeps) {
    const double own = substeps, companion = own / with.companion;
    return {companion, with.coarser > 0 ? own / with.coarser : companion};
}

double richardson_error(const StepRatios& ratios, double apart, double further) {
    const auto [r, s] = ratios;
    double order = usual_order;
    if (s > least_apart * r) {
        double low = least_order, high = most_order;  // the ratio of the two distances grows with the order
        for (int k = 0; k < 30; ++k) {
            order = 0.5 * (low + high);
            const double ratio = (std::pow(s, order) - std::pow(r, order)) / (std::pow(r, order) - 1);
            (ratio * apart < further ? low : high) = order;
        }
    }
    return apart / std::abs(std::pow(r, order) - 1);
}

}  // namespace drape
