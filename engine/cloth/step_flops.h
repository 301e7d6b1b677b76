// Counts what a step computes, for profiles.
#pragma once

#include "cloth/cloth_model.h"

namespace drape {

/// The shaders' functions take these floating-point operations, + - * / and sqrt each one, where nothing degenerates
/// and no wind blows: counted by running them on a type that counts (tests/reference/step_flops_test). A step of X (X
/// += d) is within force, predict and explicit_particle.
struct KernelFlops {
    double advance, force, predict,  ///< by particle; `predict` for second order
        explicit_particle,           ///< without the springs' part
        explicit_spring,             ///< both ends, though passes that gather compute it for each
        spring,                      ///< relaxed
        line_tension, line_spring;   ///< the first system and the second, by particle
};
inline constexpr KernelFlops kernel_flops{21, 66, 91, 71, 42, 47, 58, 73};

/// Returns those of a whole step of a cloth: fixed particles count as free ones, springs of several cells' shares as
/// one. What masks and schedules make a device compute besides does not count. 0: not known.
double step_flops(const Step& step, const ClothModel& cloth);

}  // namespace drape
