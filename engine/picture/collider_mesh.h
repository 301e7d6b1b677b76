// Turns the scene's colliders into instances of the collider shaders' meshes, in one buffer per frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "drape/scene.h"
#include "shared/collider_types.h"
#include "shared/raster_types.h"
#include "world/collider_pose.h"

namespace drape {

glsl::vec4 linear_color(const Vec3& srgb);

/// One instanced draw of the collider pipeline specialised to `kind` (shaders/shared/collider_types.h).
struct ColliderDraw {
    int kind = glsl::kind_plane;
    std::uint32_t round_columns = glsl::most_round_columns;
    std::uint32_t vertex_count = 0;
    bool has_corners = false;        ///< it is a mesh, with its vertices in a buffer
    std::uint32_t first_vertex = 0;  ///< of a mesh
    std::uint32_t first_instance = 0, instance_count = 0;
    bool casts_shadow = false;
    bool closed = true;  ///< its inner side is not visible from outside
};

/// The number of segments in the round mesh of each kind (shaders/shared/collider_types.h).
using RoundColumns = std::array<std::uint32_t, glsl::collider_kind_count>;

/// Returns the smallest number n of segments that keeps the outline of a circle of `radius` pixels within a tenth of a
/// pixel: the segments deviate from it by radius (1 - cos(pi/n)). It is a multiple of 4, at least 12, at most
/// most_round_columns.
std::uint32_t round_columns(double radius);

/// Returns a bound on the radius in pixels of a sphere, or of an ellipsoid's or capsule's largest circle, at `time`
/// (s), as the camera sees it in a picture with so many rows. It is 0 for a shape that is not round.
double radius_in_pixels(const Collider& collider, double time, const Camera& camera, std::uint32_t height);

/// Returns the kinds in the scene, those that may hide most first; each mesh is a draw of its own.
std::vector<ColliderDraw> collider_draws(const std::vector<Collider>& colliders, const RoundColumns& columns);

/// Returns the corners of all meshes at `time` (s), in the order of their draws: three for each triangle. Edges between
/// triangles that turn by less than 40 degrees look round.
std::vector<glsl::MeshCorner> mesh_corners(const std::vector<Collider>& colliders, double time);

/// Planes, which are unbounded, are drawn as a square around the point below `center`.
struct PlaneExtent {
    Vec3 center{0, 0, 0};
    double half_side = 1;      ///< m
    double line_distance = 1;  ///< m, between lines of the grid drawn on it
};

/// Returns the pose in which a plane is drawn: y is its normal, x and z run along the grid's lines.
ColliderPose plane_pose(const Collider& plane, double time);

/// Returns the instances in the order in which `collider_draws` counts them, with poses at `time` (s). `ids`: of the
/// colliders, for layers.
std::vector<glsl::ColliderInstance> collider_instances(const std::vector<Collider>& colliders,
                                                       const PlaneExtent& extent, double time,
                                                       std::span<const std::uint16_t> ids = {});

}  // namespace drape
