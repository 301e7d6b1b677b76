// The frame constants of the raster shaders: camera, lights, backdrop, and the shadow map's fit.
#pragma once

#include <array>
#include <cstdint>

#include "drape/scene.h"
#include "passes/collider_mesh.h"
#include "shared/raster_types.h"

namespace drape {

struct BoundingSphere {
    Vec3 center{0, 0, 0};
    double radius = 1;
};

/// Around the cloths at their start (and where they would land on a plane below), the bounded colliders, and
/// all of these wherever their key frames take them; cloths swing, so they count a quarter larger. An empty
/// scene's: a sphere around the camera's target.
BoundingSphere scene_extent(const SceneDescription& scene);

/// Lights that the pictures show.
std::uint32_t light_count(const SceneDescription& scene);

/// Planes fade into the backdrop over this distance from the camera's target, m.
double fade_radius(const SceneDescription& scene, const BoundingSphere& extent);
PlaneExtent plane_extent(const SceneDescription& scene, const BoundingSphere& extent);

/// The shadow map looks along the first light and holds `extent`. `shift`: RasterOptions.
glsl::FrameConstants frame_constants(const SceneDescription& scene, const BoundingSphere& extent, std::uint32_t width,
                                     std::uint32_t height, const std::array<double, 2>& shift);

}  // namespace drape
