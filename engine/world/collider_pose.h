// Where a collider is at a time, and its shape: simulation and pictures share this definition.
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

/// A shape in its own coordinate frame.
struct ShapeGeometry {
    Vec3 center;        ///< m, at rest; the shape turns about it
    Vec3 size;          ///< its parameters on the device (shared/collider_types.h); a plane's is its normal
    double reach;       ///< m, from the centre to the farthest point of the surface; infinity: it is unbounded
    double half_width;  ///< m, from the surface to the middle at its thinnest place; infinity: it has no middle
    double
        roundness;  ///< m, radius of its largest circle, for drawing it as a round mesh; 0: it is drawn in another way
    bool has_flat_sides;
    /// The axes of the shape before it is rotated, row major; nothing: those of the world.
    std::optional<std::array<double, 9>> axes = {};
};
ShapeGeometry shape_geometry(const ColliderShape& shape);

/// Returns the rest pose combined with the key-framed motion: the path's rotation turns the collider about its own
/// centre, and its translation is added. A plane's world normal is `rotate(pose.rotation, normal)`.
ColliderPose collider_pose(const Collider& collider, double time);

/// Returns the number of a mesh's pose (mesh/mesh_sequence.h) at a time, s.
double pose_number(const Mesh& mesh, double time);
/// Returns the collider in the form that it has at a time, s: unchanged, unless it deforms.
Collider formed(const Collider& collider, double time);
/// Returns a bound, m, on how far any point of its surface moves along a straight line by deforming between two times.
double deformed(const Collider& collider, double from, double to);
/// Returns how far it reaches along a direction of any length, the largest product with a point of it (its support
/// function), of a mesh with one of its bounding box, m times the length; nothing: it is unbounded.
std::optional<double> reach_along(const Collider& collider, double time, const Vec3& direction);
/// Returns whether the collider neither moves nor deforms between two times, s.
bool rests(const Collider& collider, double from, double to);

Vec3 rotate(const std::array<double, 9>& rotation, const Vec3& v);

}  // namespace drape
