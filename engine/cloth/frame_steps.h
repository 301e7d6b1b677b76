// The steps of a frame in their order, as a plain list. Pure.
#pragma once

#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// The steps of one frame: first the stiffness of cloths whose keys change it; all cloths of a substep, then the next
/// substep; at the end X += d of every cloth. Of a cloth's substep: release, wind, the method's prediction, pin motion,
/// what the method does once, then per iteration what it iterates, and collisions; with tethers it ends with them, and
/// with collisions again. When adaptive, residual and decision follow every iteration but a substep's last. Contact
/// between the cloths ends a substep of all of them.
std::vector<Step> frame_steps(const SimulationModel& model);

}  // namespace drape
