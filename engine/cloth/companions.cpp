#include "cloth/companions.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

constexpr double least_order = 0.7, usual_order = 1.4, most_order = 3;

}  // namespace

Companions companions_of(const Method& method, std::uint32_t substeps) {
    const std::uint32_t more = (3 * substeps + 1) / 2;
    if (method.trust == Method::Trust::resolves && more <= method.most_substeps) return {more, 0};
    const std::uint32_t companion = substeps == 6 ? 2 : std::max(substeps / 4, 1u);
    return {companion, companion / 2};
}

double richardson_error(const Companions& with, std::uint32_t substeps, double apart, double further) {
    const auto fallen = [](double to, double p) { return std::pow(to, -p); };
    const double n = substeps, companion = with.companion, coarser = with.coarser;
    double order = usual_order;
    if (with.coarser > 0) {
        double low = least_order, high = most_order;  // the ratio of the two distances grows with the order
        for (int k = 0; k < 30; ++k) {
            order = 0.5 * (low + high);
            const double ratio =
                (fallen(coarser, order) - fallen(companion, order)) / (fallen(companion, order) - fallen(n, order));
            (ratio * apart < further ? low : high) = order;
        }
    }
    return apart * fallen(n, order) / std::abs(fallen(companion, order) - fallen(n, order));
}

}  // namespace drape
