// One measurement of the accuracy benchmark: a problem at a size, run by one setting of one solver.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/record.h"

namespace drape::bench {

/// How a solver is driven: what a work-precision sweep varies.
struct Setting {
    SolverMethod method = SolverMethod::relax;
    std::uint32_t substeps = 1;    ///< per frame
    std::uint32_t iterations = 1;  ///< per substep
    bool operator==(const Setting&) const = default;
};

/// "20", or "1x40" for 1 substep of 40 iterations.
std::string setting_name(const Setting& setting);
/// Settings that differ only in how finely they are swept share a line in plots and fits: "relax",
/// "relax, 1 substep x iterations", "explicit".
std::string family_name(SolverMethod method, std::uint32_t substeps, std::uint32_t iterations);

/// The time of a frame over repetitions, ms.
struct Timing {
    double median = 0, least = 0;
    double spread = 0;  ///< greatest less least, over the median
    bool operator==(const Timing&) const = default;
};

/// There must be a repetition.
Timing timing_of(std::vector<double> repetitions);

/// A limit that a setting is wanted for.
struct Target {
    std::string metric;
    double limit;
};

struct CaseResult {
    std::string name;     ///< "swing/64/relax/20": what --filter is matched with
    std::string key;      ///< hash of everything that decides the result
    std::string problem;  ///< "swing"
    std::uint32_t size = 0;
    SolverMethod method = SolverMethod::automatic;
    std::uint32_t substeps = 0, iterations = 0;
    bool diverged = false;       ///< a position was no longer finite: no metrics
    double passes = 0;           ///< per frame: how often every particle is read and written; 0: of auto, which varies
    double stiffness_share = 1;  ///< the least share of the wanted stretch stiffness that the solver applied
    Timing device;               ///< per frame, the simulation alone; 0: the device has no timestamps
    Timing wall;                 ///< per frame, submits and waits included
    Metrics metrics;
    double seconds = 0;  ///< the whole case took, a new reference included

    std::optional<double> metric(const std::string& name_of_it) const {
        const auto found = metrics.find(name_of_it);
        return found == metrics.end() ? std::nullopt : std::optional(found->second);
    }
    std::string family() const { return family_name(method, substeps, iterations); }
    bool operator==(const CaseResult&) const = default;

    template <class Self>
    static void members(Self& self, const auto& see) {
        see("name", self.name), see("key", self.key), see("problem", self.problem), see("size", self.size);
        see("method", self.method), see("substeps", self.substeps), see("iterations", self.iterations);
        see("diverged", self.diverged), see("metrics", self.metrics), see("seconds", self.seconds);
        see("passes_per_frame", self.passes), see("stiffness_share", self.stiffness_share);
        see("device_ms_per_frame", self.device.median), see("device_ms_least", self.device.least);
        see("device_ms_spread", self.device.spread), see("wall_ms_per_frame", self.wall.median);
        see("wall_ms_least", self.wall.least), see("wall_ms_spread", self.wall.spread);
    }
};

/// The time that a case goes by: the device's, or the wall's where the device has no timestamps or claims more than
/// passed on the wall, frame by frame: on a loaded machine a device in software counts what others were given. Of auto
/// it is the wall's, too: the device tells of the frames that were kept, not of those that were done again.
const Timing& case_time(const CaseResult& result);

}  // namespace drape::bench
