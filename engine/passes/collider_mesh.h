// The scene's colliders as instances of the collider shaders' meshes, in one buffer per frame.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drape/scene.h"
#include "shared/collider_types.h"
#include "shared/raster_types.h"

namespace drape {

/// sRGB 0..1 -> linear.
glsl::vec4 linear_color(const Vec3& srgb);

/// One instanced draw of the collider pipeline specialised to `kind` (shaders/shared/collider_types.h).
struct ColliderDraw {
    int kind = glsl::kind_plane;
    std::uint32_t vertex_count = 0;
    std::uint32_t first_instance = 0, instance_count = 0;
    bool casts_shadow = false;
};

/// Kinds that the scene has, what may hide most first.
std::vector<ColliderDraw> collider_draws(const std::vector<Collider>& colliders);

/// How planes, which have no end, are drawn: as a square around the point below `center`.
struct PlaneExtent {
    Vec3 center{0, 0, 0};
    double half_side = 1;      ///< m
    double line_distance = 1;  ///< m, of the grid drawn on it
};

/// In the order that `collider_draws` counts, poses at `time` (s).
std::vector<glsl::ColliderInstance> collider_instances(const std::vector<Collider>& colliders,
                                                       const PlaneExtent& extent, double time);

}  // namespace drape
