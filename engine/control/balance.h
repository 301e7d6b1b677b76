#pragma once

#include <cstddef>
#include <optional>

#include "base/vectors.h"
#include "cloth/simulation_model.h"

namespace drape {

/// Returns whether some cloth starts flat and nothing in the scene leads it out of a symmetry that cloth does not keep:
/// it stands upright, is pushed together within its plane, or falls flat onto the middle of a collider. Computed motion
/// may keep such a symmetry for ever.
bool starts_in_balance(const SimulationModel& model);

/// Returns the normal of the plane in which a cloth starts upright on what holds or carries it, higher than its bending
/// can hold it up. Nothing where it hangs, is bent or lies, or where there is wind.
std::optional<Vec3> stands_upright(const SimulationModel& model, std::size_t cloth);

}  // namespace drape
