// Between the settings of a sweep: the fewest substeps that keep a limit.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace drape::bench {

struct SweepPoint {
    std::uint32_t count;  ///< substeps, or iterations
    bool keeps;           ///< the limit
};

/// What to measure next: the middle between the first count that keeps the limit and the last one before it that does
/// not (0 never does). Nothing when none keeps it, or when the two are neighbours or within 2 %.
std::optional<std::uint32_t> next_count(std::vector<SweepPoint> points);

}  // namespace drape::bench
