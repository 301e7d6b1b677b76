// A run's companion is the same scene, run beside it with other substeps. How far the two are apart tells how far the
// run is from the exact motion.
#pragma once

#include <cstdint>

#include "cloth/method.h"

namespace drape {

/// Returns the companion's substeps beside a frame of so many: a quarter, but four where a half is that or more, and a
/// half of fewer. Explicit steps, which soften the cloth where they are fewer than `auto` takes, have half as many more
/// instead (or a third less, where that is too many).
std::uint32_t companion_substeps(const Method& method, std::uint32_t substeps);

/// Returns the power of the step's length with which errors grow over a run, which explains companions' distances best
/// (docs/solvers.md). Free motion is of second order, contact and solves that end early of less; where a closed loop
/// changes the substeps of a method that it probes, hardly the first is left.
double error_order(const Method& method, bool closed_loop);

/// Returns the error of a run that is `apart` from a companion whose steps are `ratio` times as long: errors that grow
/// with the step's length to the power p put them apart by E |ratio^p - 1| (Richardson).
double richardson_error(double order, double ratio, double apart);

}  // namespace drape
