// `drape bench accuracy`: error against work for every solver.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench_request.h"

namespace drape::bench {

struct AccuracyRequest : SelectedCases {
    std::string scene;                   ///< a file to be measured against its own refined runs; empty: the benchmark's
    std::vector<std::string> overrides;  ///< of the scene: "/json/pointer=value"
    std::uint32_t frames = 0;            ///< of the scene, after the first, at most; 0: all
    std::vector<double> errors{1e-1, 1e-2, 1e-3, 1e-4};  ///< m, whose cheapest setting is asked for
    std::uint32_t reference_substeps = 1280;             ///< per frame, at most
    std::string folder = "bench";                        ///< finished cases and references, kept for the next run
                                   ///< of a scene also accuracy.json, accuracy.csv and plots unless they go elsewhere
};

struct AccuracySummary {
    std::string text;  ///< the table
    bool stopped = false;
    std::size_t measured_count = 0, kept_count = 0, left_out_count = 0;  ///< left out by the budget
    std::size_t computed_reference_count = 0;
    std::size_t missed_count = 0;        ///< limits, orders and promises of auto that the results do not meet
    std::uint64_t validation_count = 0;  ///< messages
};

/// Runs the cases in order of importance, the coarse settings of a sweep first; a sweep ends when its error
/// has reached the floor of what can be told. Files are written at the end, each whole. Throws UsageError,
/// OutputError, DeviceError, SceneFailure, and Diverged where no refined run of a scene stays finite.
AccuracySummary run_accuracy(const AccuracyRequest& request);

}  // namespace drape::bench
