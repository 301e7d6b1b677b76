// The world of a scene has an axis that points up. Nothing else knows it: what depends on it asks here.
#pragma once

#include <cstddef>

#include "drape/scene.h"

namespace drape {

/// Returns the coordinate that grows upwards.
inline std::size_t up_axis(Up up) { return up == Up::z ? 2 : 1; }

/// Returns in a scene's world what is `v` in a world with y up, turned about x: y becomes z, and z becomes -y.
inline Vec3 in_world(Up up, const Vec3& v) { return up == Up::z ? Vec3{v[0], 0 - v[2], v[1]} : v; }

/// Returns the inverse of in_world: what a vector of a scene's world is in one with y up.
inline Vec3 with_y_up(Up up, const Vec3& v) { return up == Up::z ? Vec3{v[0], v[2], 0 - v[1]} : v; }

}  // namespace drape
