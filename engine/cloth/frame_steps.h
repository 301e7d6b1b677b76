// The steps of a frame in their order, as a plain list. Pure.
#pragma once

#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns the steps of one frame. It begins with the stiffness of cloths whose keys change it; then come the substeps,
/// each for all cloths; it ends with X += d of every cloth. A cloth's substep consists of release, wind, the method's
/// prediction, pin motion, the method's steps that are taken once, then in each iteration the method's iterated steps
/// and collisions; with tethers, these and another collision follow. In an adaptive run, residual and decision follow
/// every iteration but a substep's last. Where cloths are sewn, they go through these parts of a substep in turn, and
/// what one does to a seam is handed on before the next. Contact between cloths ends a substep of all of them.
std::vector<Step> frame_steps(const SimulationModel& model);

/// Returns the steps that follow the normals of all cloths: at seams, theirs become one.
std::vector<Step> normal_steps(const SimulationModel& model);

}  // namespace drape
