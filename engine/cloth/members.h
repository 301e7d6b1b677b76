// Members of an ensemble are scenes of one shape, which differ in numbers; their cloths are simulated together
// (cloth/together.h), each with its own scene's wind and colliders. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/frame_inputs.h"

namespace drape {

/// Returns in what a scene is of another shape than the first, as a JSON pointer and both values: grids, holes, pinned
/// particles, kinds of colliders, whether something moves, solver settings that decide the steps. Nothing: in nothing.
std::optional<std::string> shape_difference(const SceneDescription& first, const SceneDescription& other);

/// Returns why members of this shape take their dispatches one by one; nothing: they share them.
std::optional<std::string> sharing_obstacle(const SimulationModel& model);

/// Puts the inputs of all members of `all` in the place of others; where colliders of any move, each gets records for
/// every substep, which for colliders at rest are those of the first.
void join_inputs(const SimulationModel& all, const std::vector<FrameInputs>& members, FrameInputs& joined);

}  // namespace drape
