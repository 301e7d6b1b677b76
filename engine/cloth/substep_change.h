// Changes a cloth's state when its substeps get another length (docs/solvers.md, "Substeps that change").
#pragma once

#include <vector>

#include "cloth/simulation_model.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Returns the changes by cloth, from `before` substeps per frame to `after`.
std::vector<glsl::SubstepChange> substep_changes(const SimulationModel& model, std::uint32_t before,
                                                 std::uint32_t after);

}  // namespace drape
