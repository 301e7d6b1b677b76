// The results of `drape bench speed`, for people and programs.
#pragma once

#include <string>
#include <vector>

#include "bench/bench_run.h"
#include "bench/speed_case.h"
#include "cloth/device_costs.h"
#include "plot/plot.h"
#include "profile/profile.h"

namespace drape::bench {

/// Times of a case by name, ms per frame but for starts, statistics of the means of rounds. Cases of a solver: "frame"
/// (from one frame's end to the next), "device" (of those, the device's own time, where it has timestamps). Pictures:
/// "frame" and the device's stages. Skips: "frame", "without". Kernels: "frame", as `auto` runs it, and each by its
/// name. Ensembles: "frame", a step of all members, "device", and "alone", a frame of one by itself on one thread.
/// Starts, cold and warm: their parts.
struct SpeedTime {
    std::string name;
    profile::Statistics statistics;
    /// Its repetitions are too far apart: interquartile range over the median above 30 %.
    bool doubtful() const { return statistics.spread > 0.3; }
};

struct SpeedResult {
    SpeedCase about;
    std::string note{};  ///< what is skipped; the kernels that were taken
    std::vector<SpeedTime> times{};
    double bytes = 0, flops = 0;  ///< of a frame, by what its passes declare; 0: not known

    const SpeedTime* find(const std::string& name) const;
    /// Median of one over that of another; 0 where there is none.
    double ratio(const std::string& name, const std::string& to) const;
};

/// How a time grows over the cases of a group: t ~ x^exponent.
struct ScalingFit {
    std::string group, time, variable;  ///< variable: "particles", "cloths"
    std::vector<std::array<double, 2>> points;
    double exponent = 0;
};

/// For sheets the growth of ms per substep with the particles, from 64x64 on; for several cloths with their number.
/// There are three points at least.
std::vector<ScalingFit> fit_scaling(const std::vector<SpeedResult>& results);

/// The cost of a bare substep as it was measured: what cloth/device_costs.h has for every kind of device.
struct MeasuredCost {
    SolverMethod method;
    SubstepCost cost;
};

/// Fits "frame" of the cases of kernels by method, with the least squares of relative errors. There are two sizes of a
/// single cloth at least.
std::vector<MeasuredCost> fit_costs(const std::vector<SpeedResult>& results);

struct SpeedReport : ReportHead {
    int cores = 1;
    double copy_bandwidth = 0;  ///< bytes/s; 0: not known
    std::vector<SpeedResult> results{};
};

std::string speed_text(const SpeedReport& report);
std::string speed_json(const SpeedReport& report);
/// A row per case and time.
std::string speed_csv(const SpeedReport& report);
/// File names and plots: per group of sheets ns per particle and substep against particles, of cloths and colliders
/// ms per substep against their number. Only of what has two points or more.
plot::Plots speed_plots(const SpeedReport& report);

}  // namespace drape::bench
