#pragma once

#include "cloth/simulation_model.h"

namespace drape {

/// Returns whether some cloth starts flat and nothing in the scene leads it out of a symmetry that cloth does not keep:
/// it stands upright, is pushed together within its plane, or falls flat onto the middle of a collider. Computed motion
/// may keep such a symmetry for ever.
bool starts_in_balance(const SimulationModel& model);

}  // namespace drape
