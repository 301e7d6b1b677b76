// A run's companion is the same scene, simulated beside it with other substeps. The distance between the two shows how
// far the run is from the exact motion.
#pragma once

#include <cstdint>

#include "cloth/method.h"

namespace drape {

/// Returns the companion's substeps for a frame with so many: a quarter of them, but at least four, or half of them if
/// that is less. With explicit steps, which soften the cloth where they are fewer than `auto` takes, the companion has
/// half as many more (or a third fewer, where that would be too many).
std::uint32_t companion_substeps(const Method& method, std::uint32_t substeps);

/// Returns the power p of the step's length with which errors grow over a run that best explains companions' distances
/// (docs/solvers.md). Free motion is of second order; contact, and solves that end early, of a lower one. Where a
/// closed loop changes the substeps of a method that it probes, hardly more than the first order remains.
double error_order(const Method& method, bool closed_loop);

/// Returns the error E of a run whose distance from its companion is `apart`, where the companion's steps are `ratio`
/// times as long: errors that grow with the power p of the step's length cause a distance of E |ratio^p - 1|
/// (Richardson).
double richardson_error(double order, double ratio, double apart);

}  // namespace drape
