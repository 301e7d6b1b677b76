// The frame constants of the raster shaders: camera, lights, backdrop, and the shadow map's fit.
#pragma once

#include <array>
#include <cstdint>

#include "drape/scene.h"
#include "passes/collider_mesh.h"
#include "passes/framing.h"
#include "shared/raster_types.h"

namespace drape {

/// Lights that the pictures show.
std::uint32_t light_count(const SceneDescription& scene);

/// Planes fade into the backdrop over this distance from the camera's target, m.
double fade_radius(const Camera& camera, const BoundingSphere& extent);
PlaneExtent plane_extent(const Camera& camera, const BoundingSphere& extent);

/// The shadow map looks along the first light and holds `extent`. `shift`: RasterOptions.
glsl::FrameConstants frame_constants(const SceneDescription& scene, const Camera& camera, const BoundingSphere& extent,
                                     std::uint32_t width, std::uint32_t height, const std::array<double, 2>& shift);

}  // namespace drape
