// Where a collider is at a time, and what simulation and pictures know of its shape: one definition for both.
#pragma once

#include <array>
#include <optional>

#include "drape/scene.h"

namespace drape {

/// x_world = center + rotation * x_local, metres.
struct ColliderPose {
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row major
    Vec3 center{0, 0, 0};
    bool operator==(const ColliderPose&) const = default;
};

/// A shape in its own frame.
struct ShapeGeometry {
    Vec3 center;   ///< m, at rest: what it turns about
    Vec3 size;     ///< what the device knows of it (shared/collider_types.h); a plane's: its normal
    double reach;  ///< m, of the surface from the centre; infinity: it has no end
    /// How its own axes lie before it is rotated, row major; nothing: along the world's.
    std::optional<std::array<double, 9>> axes = {};
};
ShapeGeometry shape_geometry(const ColliderShape& shape);

/// Its rest pose with its key-framed motion on top: the path's rotation turns it about its own centre, its translation
/// is added. A plane's world normal is `rotate(pose.rotation, normal)`.
ColliderPose collider_pose(const Collider& collider, double time);

/// rotation * v.
Vec3 rotate(const std::array<double, 9>& rotation, const Vec3& v);

}  // namespace drape
