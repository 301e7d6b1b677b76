// The surfaces of colliders as triangle meshes, for files: the same points that pictures draw.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drape/scene.h"
#include "world/collider_pose.h"

namespace drape {

/// Triangles run counter-clockwise seen from outside.
struct ColliderSurface {
    std::vector<Vec3> vertices;  ///< m, in the collider's own frame (surface_pose)
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A plane, which is unbounded, becomes a square of this half side, m, around its point below `center` at time 0.
struct PlaneSquare {
    Vec3 center{0, 0, 0};
    double half_side = 1;
};

/// Returns a square that contains everything else in the scene.
PlaneSquare plane_square(const SceneDescription& scene);

/// Returns the surface of any collider; its vertices lie on the true one. Round ones have `columns` segments around, a
/// multiple of 4 and at least 8, and half as many from pole to pole, so the numbers of vertices and triangles follow
/// from the kind alone. A mesh has the triangles of its file, its vertices in the order of their places.
ColliderSurface collider_surface(const Collider& collider, int columns, const PlaneSquare& square);

/// Returns the pose of the surface at a time, s.
ColliderPose surface_pose(const Collider& collider, double time);

}  // namespace drape
