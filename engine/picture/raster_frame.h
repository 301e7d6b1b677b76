// Makes the frame constants of the raster shaders: camera, lights, backdrop, and the shadow map's fit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "drape/scene.h"
#include "picture/collider_mesh.h"
#include "picture/framing.h"
#include "shared/raster_types.h"

namespace drape {

/// Returns how many lights the pictures show.
std::uint32_t light_count(const SceneDescription& scene);

/// Returns the distance from the camera's target over which planes fade into the backdrop, m.
double fade_radius(const Camera& camera, const BoundingSphere& extent);
PlaneExtent plane_extent(const Camera& camera, const BoundingSphere& extent);

/// Returns the plane that the encoding pass draws behind everything else: the first of the colliders that stands still
/// with the camera above it.
std::optional<std::size_t> floor_of(const std::vector<Collider>& colliders, const Camera& camera);

struct PictureGeometry {
    Camera camera;
    BoundingSphere extent;
    std::uint32_t width = 0, height = 0;
    std::array<double, 2> shift{0, 0};  ///< RasterOptions::shift
};

/// The shadow map looks along the first light and holds the extent. `floor`: null where there is none.
glsl::FrameConstants frame_constants(const SceneDescription& scene, const PictureGeometry& picture,
                                     const Collider* floor);

}  // namespace drape
