// `drape bench speed`: Drape's times beside those of the same arithmetic in native C++, on one core and all, and beside
// what the device's memory moves; what skips save; what a start takes.
#pragma once

#include <cstdint>
#include <string>

#include "bench/bench_request.h"

namespace drape::bench {

struct SpeedRequest : SelectedCases {
    bool tune = false;              ///< the cases of kernels instead of all others
    std::string scenes = "scenes";  ///< folder of the shipped scenes; what needs one that is not there is left out
};

struct SpeedSummary {
    std::string text;  ///< the tables
    bool stopped = false;
    std::size_t measured_count = 0, left_out_count = 0;  ///< left out by the budget or for want of a scene
    std::uint64_t validation_count = 0;                  ///< messages
};

/// Runs the cases, important ones first. Files are written at the end, each whole. Throws UsageError, OutputError,
/// DeviceError.
SpeedSummary run_speed(const SpeedRequest& request);

}  // namespace drape::bench
