// Changes a cloth's state when its substeps get another length (docs/solvers.md, "Substeps that change").
#pragma once

#include <vector>

#include "cloth/simulation_model.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Returns what half of the last change of a displacement counts for (docs/solvers.md): with d its substep's and b that
/// of the one before, h times the velocity at a substep's end is d + (d - b)/2 times this. Without damping it is 1, and
/// under it what makes that exact in flight, while damping leaves more than a third of a velocity in a substep.
double excess_share(double damping, double substep);

/// Returns the changes by cloth, from `before` substeps per frame to `after`.
std::vector<glsl::SubstepChange> substep_changes(const SimulationModel& model, std::uint32_t before,
                                                 std::uint32_t after);

}  // namespace drape
