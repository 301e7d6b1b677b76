// The benchmarks: `drape bench accuracy`, `drape bench speed` and `drape bench fabric`. Each runs its cases, the
// important ones first, and writes what was asked for at the end, each file whole. All throw UsageError, OutputError,
// DeviceError and Stopped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_run.h"

namespace drape::bench {

/// Error against work for every solver.
struct AccuracyRequest : SelectedCases {
    std::string scene;                   ///< a file to be measured against its own refined runs; empty: the benchmark's
    std::vector<std::string> overrides;  ///< of the scene: "/json/pointer=value"
    std::uint32_t frames = 0;            ///< of the scene, after the first, at most; 0: all
    std::vector<double> errors{1e-1, 1e-2, 1e-3, 1e-4};  ///< m, whose cheapest setting is asked for
    std::uint32_t reference_substeps = 1280;             ///< per frame, at most
    /// Finished cases and references, kept for the next run; of a scene also accuracy.json, accuracy.csv and plots
    /// unless they go elsewhere.
    std::string folder = "bench";
};

/// A sweep begins with its coarse settings and ends when its error has reached the floor of what can be told. Also
/// throws SceneFailure, and Diverged where no refined run of a scene stays finite.
BenchSummary run_accuracy(const AccuracyRequest& request);

/// Drape's times beside the device's own and what its memory moves; what skips save; what a start takes.
struct SpeedRequest : SelectedCases {
    bool tune = false;              ///< measures sets of kernels instead of all else
    std::string scenes = "scenes";  ///< folder of the shipped scenes; cases whose scene is not there are left out
};

BenchSummary run_speed(const SpeedRequest& request);

/// The fabrics as a laboratory measures them.
struct FabricRequest : BenchRequest {
    std::string fabric;      ///< empty: all
    std::uint32_t grid = 0;  ///< particles a side; 0: 65 and 97
};

BenchSummary run_fabric(const FabricRequest& request);

}  // namespace drape::bench
