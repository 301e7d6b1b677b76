// Companions of a run are the same scene, run beside it with fewer substeps. How far they are from it and from each
// other tells how far the run is from the exact motion.
#pragma once

#include <cstdint>

#include "cloth/method.h"

namespace drape {

/// The substeps of the runs beside one.
struct Companions {
    std::uint32_t companion;
    std::uint32_t coarser;  ///< 0: there is none, in any frame
};
/// Returns those beside a frame of so many substeps: a quarter and an eighth, or a half and a quarter where that were
/// fewer than four and two. Explicit steps, which soften the cloth where they are fewer than `auto` takes, have one
/// companion with half as many more instead (or a third less, where that is too many).
Companions companions_of(const Method& method, std::uint32_t substeps);

/// The mean power of the step's length with which errors grew in the scenes that were tried.
inline constexpr double usual_order = 1.4;

/// How many times as long the substeps of the runs beside one are as its own.
struct StepRatios {
    double companion = 1, coarser = 1;
};
StepRatios step_ratios(const Companions& with, std::uint32_t substeps);

/// Returns Richardson's estimate of a run's error. An error E of steps that grows with their length to the power p is
/// `apart` = E (r^p - 1) from the companion with steps r times as long, and that `further` = E (s^p - r^p) from the
/// coarser one, s; the two tell p, taken between 0.7 (contact, and errors that substeps so long hardly show) and 3
/// (free motion has 2, solves that come to converge more). Without one that is coarser p is the usual one.
double richardson_error(const StepRatios& ratios, double apart, double further);

}  // namespace drape
