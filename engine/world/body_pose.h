// Where bodies that cloth moves are, which only a run can tell.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "drape/frame.h"
#include "drape/scene.h"

namespace drape {

/// Returns the unit quaternion (x y z, and w, the real part) of a rotation, row major, and its inverse.
std::array<double, 4> quaternion_of(const std::array<double, 9>& rotation);
std::array<double, 9> rotation_of(const std::array<double, 4>& quaternion);

/// Returns a body that rests where it is in a frame: `collider_pose` of it is that pose at every time.
Collider placed(const Collider& body, const BodyState& state);
/// Returns a scene's colliders with its bodies so placed.
std::vector<Collider> placed(const std::vector<Collider>& colliders, std::span<const BodyState> bodies);

}  // namespace drape
