// Members of an ensemble are scenes of one shape that differ in numbers. Their cloths are simulated together
// (cloth/together.h), each with its own scene's wind and colliders. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/frame_inputs.h"

namespace drape {

/// Returns how a scene's shape differs from the first one's, as a JSON pointer and both values. Shape means grids,
/// holes, pinned particles, kinds of colliders, whether something moves, and solver settings that decide the steps.
/// Nothing: the shapes are equal.
std::optional<std::string> shape_difference(const SceneDescription& first, const SceneDescription& other);

/// Returns why members of this shape cannot share dispatches; nothing: they can.
std::optional<std::string> sharing_obstacle(const SimulationModel& model);

/// Replaces `joined` by the inputs of all members of `all`. Where colliders of any member move, every member gets
/// records for every substep; those of colliders at rest repeat the first substep's.
void join_inputs(const SimulationModel& all, const std::vector<FrameInputs>& members, FrameInputs& joined);

}  // namespace drape
