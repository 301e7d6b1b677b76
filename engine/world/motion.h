// Evaluates key-framed rigid motion on the host in double precision.
#pragma once

#include <array>

#include "drape/scene.h"

namespace drape {

/// Maps x to rotation * x + translation, about whatever centre the owner of the path states.
struct RigidTransform {
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row major
    Vec3 translation{0, 0, 0};                                  ///< m
    bool operator==(const RigidTransform&) const = default;
};

/// Returns R = Rz Ry Rx of angles in degrees: it turns about x, then y, then z. It is exact at multiples of 90 degrees
/// (so a whole turn is exactly the identity), elsewhere within a few ulp.
std::array<double, 9> rotation_matrix(const Vec3& degrees);

/// Returns the key that a path would have at `time` (s). Translation and angles are interpolated component by
/// component: cubic Hermite between neighbouring keys, with slope (p[k+1] - p[k-1]) / (t[k+1] - t[k-1]) at inner keys
/// (Catmull-Rom on uneven times) and 0 at the first and last key; outside, the end keys hold. So that no component
/// leaves the range of the two keys around it, a slope is at most three times as steep as the straight lines to both
/// neighbours, and 0 where one of these is level or they go opposite ways. The result equals the key at a key's time
/// exactly, and for an empty path it is exactly no motion.
MotionKey key_at(const MotionPath& path, double time);
/// Returns whether a path is constant between two times, s.
bool rests(const MotionPath& path, double from, double to);
/// Returns the transform of the key at `time`.
RigidTransform motion_at(const MotionPath& path, double time);

}  // namespace drape
