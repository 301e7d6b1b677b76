// Companions of a run are the same scene, run beside it with fewer substeps. How far they are from it and from each
// other tells how far the run is from the exact motion.
#pragma once

#include <cstdint>

#include "cloth/method.h"

namespace drape {

/// The substeps of the runs beside one.
struct Companions {
    std::uint32_t companion;
    std::uint32_t coarser;  ///< 0: there is none
};
/// Returns those beside a frame of so many substeps: about a quarter and an eighth, where there are enough. Explicit
/// steps, which soften the cloth where they are fewer than `auto` takes, have a companion with half as many more
/// instead.
Companions companions_of(const Method& method, std::uint32_t substeps);

/// Returns Richardson's estimate of the error of n substeps. An error that falls with n to the power p has
/// `apart` = C (n_c^-p - n^-p) from the companion, and that `further` = C (n_cc^-p - n_c^-p) from the coarser one; the
/// two tell p, taken between 0.7 (contact, and errors that substeps so long hardly show) and 3 (free motion has 2,
/// solves that come to converge more). Without a coarser one p is 1.4, the mean of what scenes showed.
double richardson_error(const Companions& with, std::uint32_t substeps, double apart, double further);

}  // namespace drape
