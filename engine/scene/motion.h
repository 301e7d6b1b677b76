// Key-framed rigid motion, evaluated on the host in double precision.
#pragma once

#include <array>

#include "drape/scene.h"

namespace drape {

/// x -> rotation * x + translation, about whatever centre the owner of the path states.
struct RigidTransform {
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row major
    Vec3 translation{0, 0, 0};                                  ///< metres
    bool operator==(const RigidTransform&) const = default;
};

/// R = Rz Ry Rx of angles in degrees: turns about x, then y, then z. Exact at multiples of 90 degrees
/// (so a whole turn is exactly the identity); elsewhere within a few ulp.
std::array<double, 9> rotation_matrix(const Vec3& degrees);

/// The transform of a path at `time` (seconds). Translation and angles are interpolated component by
/// component: cubic Hermite between neighbouring keys, slope (p[k+1] - p[k-1]) / (t[k+1] - t[k-1]) at inner
/// keys (Catmull-Rom on uneven times), 0 at the first and last key; before and after, the end keys hold.
/// Exactly the key at a key's time, exactly the identity for an empty path.
RigidTransform motion_at(const MotionPath& path, double time);

}  // namespace drape
