// Scenes for judging `auto` that nobody tunes by: all that a scene may hold, in combinations that no one would think
// of. Written apart from random_scenes.h and sharing nothing with it, so that what one forgets the other may have.
#pragma once

#include <cstdint>

#include "drape/scene.h"

namespace drape::bench {

/// Scene number `index` of a seed, the same on every machine, of method `auto`: one to three cloths of 2 x 2 to
/// 129 x 129 particles (log-uniform), 0.02 to 1 kg/m^2, limp to rigid, bending 0 to 1e-2 N m, hung, thrown, released,
/// dragged along paths or pulled taut; gravity, none or another; still air to 60 m/s with gusts; up to four colliders
/// of all kinds, still or moving; cutters; 30 to 90 frames. What cannot be is left out: rigid cloth is not pulled, and
/// no collider starts within a cloth.
SceneDescription wild_scene(std::uint64_t seed, std::uint32_t index);

}  // namespace drape::bench
