// Scenes drawn from a seed, the same on every machine.
#pragma once

#include <cstdint>

#include "drape/scene.h"

namespace drape::bench {

/// A scene such as `auto` is tuned on: one cloth of 20 to 90 particles a side, 0.08 to 0.5 kg/m^2, 500 to 10,000 N/m:
/// swinging from an edge, hanging from two corners, falling on a ball, a flag in 2 to 8 m/s, or held all around; 46
/// frames.
SceneDescription random_scene(std::uint32_t seed);

/// Scene `index` of a seed, of method `auto`: a random_scene with more of what a scene may hold: wind to 30 m/s with
/// gusts, weightlessness, pins that are released or move, rigid cloth, bending to 1e-3 N m, small and narrow grids,
/// more colliders, still and moving, a second cloth, a blade; 30 to 90 frames.
SceneDescription full_random_scene(std::uint32_t seed, std::uint32_t index);

/// Scenes for judging `auto` that nobody tunes by: all that a scene may hold, in combinations that no one would think
/// of, written apart from those above and sharing nothing with them, so that what one forgets the other may have.
///
/// Scene number `index` of a seed, of method `auto`: one to three cloths of 2 x 2 to
/// 129 x 129 particles (log-uniform), 0.02 to 1 kg/m^2, limp to rigid, bending 0 to 1e-2 N m, hung, thrown, released,
/// dragged along paths or pulled taut; gravity, none or another; still air to 60 m/s with gusts; up to four colliders
/// of all kinds, still or moving; cutters; 30 to 90 frames. What cannot be is left out: rigid cloth is not pulled, and
/// no collider starts within a cloth.
SceneDescription wild_scene(std::uint32_t seed, std::uint32_t index);

}  // namespace drape::bench
