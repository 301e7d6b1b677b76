#include "bench/bisection.h"

#include <algorithm>

namespace drape::bench {

std::optional<std::uint32_t> next_count(std::vector<SweepPoint> points) {
    std::ranges::sort(points, {}, &SweepPoint::count);
    const auto first = std::ranges::find(points, true, &SweepPoint::keeps);
    if (first == points.end()) return std::nullopt;
    const std::uint32_t high = first->count, low = first == points.begin() ? 0 : std::prev(first)->count;
    if (high - low <= std::max(1u, high / 50)) return std::nullopt;
    return low + (high - low) / 2;
}

}  // namespace drape::bench
