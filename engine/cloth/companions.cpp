#include "cloth/companions.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// In contact, runs with fewer substeps are so far from all others that their distances say nothing about the others.
constexpr std::uint32_t least_companion = 4;

bool has_more(const Method& method) { return method.trust == Method::Trust::resolves; }

}  // namespace

std::uint32_t companion_substeps(const Method& method, std::uint32_t substeps) {
    const std::uint32_t more = (3 * substeps + 1) / 2;
    if (has_more(method)) return more <= method.most_substeps ? more : 2 * substeps / 3;
    if (substeps == 1) return more;
    return std::max(substeps / 4, std::min(least_companion, substeps / 2));
}

double error_order(const Method& method, bool closed_loop) {
    return closed_loop && method.trust == Method::Trust::probed ? 0.8 : 1.4;
}

double richardson_error(double order, double ratio, double apart) {
    return apart / std::abs(std::pow(ratio, order) - 1);
}

}  // namespace drape
