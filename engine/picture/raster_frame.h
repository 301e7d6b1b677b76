// Makes the frame constants of the raster shaders: camera, lights, backdrop, and the shadow map's fit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "drape/scene.h"
#include "picture/camera.h"
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
/// with the camera above it, wherever that moves.
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

/// What a scene's pictures are seen from, and in which light.
class FrameView {
  public:
    FrameView(const SceneDescription& scene, const PictureGeometry& picture);
    Camera camera_at(double time) const { return drape::camera_at(picture_.camera, time); }
    glsl::FrameConstants constants_at(double time) const;
    PlaneExtent plane_extent_at(double time) const;
    /// Returns which of the scene's colliders is the floor.
    std::optional<std::size_t> floor() const { return floor_; }
    const BoundingSphere& extent() const { return picture_.extent; }

  private:
    glsl::FrameConstants constants_from(const Camera& camera) const;

    SceneDescription light_;  ///< the scene without what is in it
    PictureGeometry picture_;
    std::optional<std::size_t> floor_;
    std::optional<Collider> floor_body_;
    glsl::FrameConstants still_;  ///< of the start, and of all times where the camera stands still
};

}  // namespace drape
