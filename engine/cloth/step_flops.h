// Counts the floating-point operations of a step, for profiles.
#pragma once

#include "cloth/cloth_model.h"

namespace drape {

/// The floating-point operations (+ - * / and sqrt count one each) of the shaders' functions where nothing degenerates
/// and no wind blows. They were counted by running the functions on a type that counts
/// (tests/reference/step_flops_test). Advancing the position (X += d) is included in force, predict and
/// explicit_particle.
struct KernelFlops {
    double advance, force, predict,  ///< by particle; `predict` for second order
        explicit_particle,           ///< without the springs' part
        explicit_spring,             ///< for both ends, though passes that gather compute it at each end
        spring,                      ///< relaxed
        line_tension, line_spring;   ///< the first system and the second, by particle
};
inline constexpr KernelFlops kernel_flops{21, 66, 91, 71, 42, 47, 58, 73};

/// Returns the operations of a whole step of a cloth. Fixed particles count as free ones, and a spring with shares of
/// several cells as one. Additional work of a device by masks and schedules does not count. 0: not known.
double step_flops(const Step& step, const ClothModel& cloth);

}  // namespace drape
