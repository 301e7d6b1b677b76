// Simulation and pictures share this definition of where a collider is at a time and of its shape.
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
    Vec3 center;        ///< m, at rest; the shape turns about it
    Vec3 size;          ///< its form on the device (shared/collider_types.h); a plane's is its normal
    double reach;       ///< m, the surface's farthest from the centre; infinity: it has no end
    double half_width;  ///< m, from the surface to the middle where it is the thinnest; infinity: it has no middle
    double roundness;   ///< m, radius of its largest circle, by which a round mesh draws it; 0: it is not drawn so
    bool has_flat_sides;
    /// The shape's own axes before it is rotated, row major; nothing: the world's.
    std::optional<std::array<double, 9>> axes = {};
};
ShapeGeometry shape_geometry(const ColliderShape& shape);

/// Returns the rest pose with the key-framed motion on top: the path's rotation turns it about its own centre, its
/// translation is added. A plane's world normal is `rotate(pose.rotation, normal)`.
ColliderPose collider_pose(const Collider& collider, double time);

/// Returns the number of a mesh's pose (mesh/mesh_sequence.h) at a time, s.
double pose_number(const Mesh& mesh, double time);
/// Returns the collider with the form that it has at a time, s: itself, unless it deforms.
Collider formed(const Collider& collider, double time);
/// Returns what no point of its surface moves farther than by deforming between two times, by a straight line, m.
double deformed(const Collider& collider, double from, double to);
/// Returns whether the collider is where and as it is at each instant between two times, s.
bool rests(const Collider& collider, double from, double to);

Vec3 rotate(const std::array<double, 9>& rotation, const Vec3& v);

}  // namespace drape
