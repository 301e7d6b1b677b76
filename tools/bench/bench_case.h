// One measurement of the accuracy benchmark: a problem at a size, run by one setting of one solver.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "drape/scene.h"

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

/// Errors and other numbers by name, SI units.
using Metrics = std::map<std::string, double>;

struct CaseResult {
    std::string name;     ///< "swing/64/relax/20": what --filter is matched with
    std::string key;      ///< hash of everything that decides the result
    std::string problem;  ///< "swing"
    std::uint32_t size = 0;
    SolverMethod method = SolverMethod::automatic;
    std::uint32_t substeps = 0, iterations = 0;
    bool diverged = false;       ///< a position was no longer finite: no metrics
    double passes = 0;           ///< per frame: how often every particle is read and written
    double stiffness_share = 1;  ///< the least share of the wanted stretch stiffness that the solver applied
    /// Per frame, ms, the simulation alone: median of all frames of all repetitions, and the least and
    /// greatest repetition's median. 0: the device has no timestamps.
    double device_ms = 0, device_ms_low = 0, device_ms_high = 0;
    double wall_ms = 0;  ///< per frame, of the fastest repetition, submits and waits included
    Metrics metrics;
    double seconds = 0;  ///< the whole case took, a new reference included

    std::string family() const { return family_name(method, substeps, iterations); }
    bool operator==(const CaseResult&) const = default;
};

}  // namespace drape::bench
