// Scenes drawn from a seed, the same on every machine.
#pragma once

#include <cstdint>

#include "drape/scene.h"

namespace drape::bench {

/// A scene such as `auto` is tuned on: one cloth of 20 to 90 particles a side, 0.08 to 0.5 kg/m^2, 500 to 10,000 N/m:
/// swinging from an edge, hanging from two corners, falling on a ball, a flag in 2 to 8 m/s, or held all around; 46
/// frames. ../campaign/drawn_a.py draws the same sheets.
SceneDescription random_scene(std::uint32_t seed);

}  // namespace drape::bench
