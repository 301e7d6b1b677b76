// `drape bench stability`: extremes alone, in pairs and in drawn mixes by every method, random scenes and a soak,
// judged from outside.
#pragma once

#include "bench/bench_request.h"

namespace drape::bench {

struct StabilityRequest : SelectedCases {
    std::uint32_t seed = 1;
    std::optional<std::uint32_t> mixes, randoms;  ///< how many; default: by `is_short`
    std::string folder = "bench_stability";       ///< finished cases, a line each, kept for the next run
};

struct StabilitySummary {
    std::string text;
    bool stopped = false;
    std::size_t run_count = 0, kept_count = 0, left_out_count = 0;
    std::size_t short_count = 0;    ///< cases short of their tier
    std::size_t garbage_count = 0;  ///< of them silent garbage
    std::uint64_t validation_count = 0;
};

/// Throws UsageError, OutputError, DeviceError.
StabilitySummary run_stability(const StabilityRequest& request);

}  // namespace drape::bench
