// What `drape bench speed` found out.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/speed_case.h"
#include "profile/profile.h"

namespace drape::bench {

/// Times of a case by name, ms per frame but for starts, statistics of the means of rounds. Cases of a solver: "frame"
/// (from one frame's end to the next), "device" (of those, the device's own time, where it has timestamps), "native"
/// (the same arithmetic in C++ on all cores), "native, one core", "native, scalar" (on one core, compiled without
/// vectors). Pictures: "frame" and the device's stages. Skips: "frame", "without". Kernels: "frame", as `auto` runs
/// it, and each by its name. Starts, cold and warm: their parts.
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

/// Of sheets, ms per substep against particles from 64x64 on; of cloths, against their number. Three points at least.
std::vector<ScalingFit> fit_scaling(const std::vector<SpeedResult>& results);

}  // namespace drape::bench
