// Scenes drawn from a seed, such as `auto` is tuned on.
#pragma once

#include <cstdint>

#include "drape/scene.h"

namespace drape::bench {

/// One cloth of 20 to 90 particles a side, 0.08 to 0.5 kg/m^2, 500 to 10,000 N/m: swinging from an edge, hanging from
/// two corners, falling on a ball, a flag in 2 to 8 m/s, or held all around; 46 frames.
SceneDescription random_scene(std::uint32_t seed);

/// Scene `index` of a seed, of method `auto`: a random_scene with more of what a scene may hold: wind to 30 m/s with
/// gusts, weightlessness, pins that are released or move, rigid cloth, bending to 1e-3 N m, small and narrow grids,
/// more colliders, still and moving, a second cloth, a blade; 30 to 90 frames.
SceneDescription full_random_scene(std::uint32_t seed, std::uint32_t index);

}  // namespace drape::bench
