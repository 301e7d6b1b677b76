// Which axis of a scene's world points up. All code that depends on it uses these functions.
#pragma once

#include <cstddef>

#include "drape/scene.h"

namespace drape {

/// Returns the coordinate that grows upwards.
inline std::size_t up_axis(Up up) { return up == Up::z ? 2 : 1; }

/// Converts `v` from a world with y up to the scene's world, by a turn about x: y becomes z, and z becomes -y.
inline Vec3 in_world(Up up, const Vec3& v) { return up == Up::z ? Vec3{v[0], 0 - v[2], v[1]} : v; }

/// Converts a vector of the scene's world to a world with y up: the inverse of in_world.
inline Vec3 with_y_up(Up up, const Vec3& v) { return up == Up::z ? Vec3{v[0], v[2], 0 - v[1]} : v; }

}  // namespace drape
