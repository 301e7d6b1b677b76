// Finds the extent of a scene, and a camera for a scene that names none.
#pragma once

#include <cstdint>

#include "drape/scene.h"

namespace drape {

struct BoundingSphere {
    Vec3 center{0, 0, 0};
    double radius = 1;
};

/// Returns a sphere around the cloths at their start (and where they would land on a plane below), the bounded
/// colliders, and all of these wherever their key frames take them; cloths swing, so they count a quarter larger. An
/// empty scene has a sphere of radius 1 around the origin.
BoundingSphere scene_extent(const SceneDescription& scene);

/// Returns the scene's camera; without one, a camera that looks from the right, the front and above at its colliders
/// and at its cloths where they start, hang and land, as near as keeps all of them in the picture, whatever its shape.
Camera picture_camera(const SceneDescription& scene, std::uint32_t width, std::uint32_t height);

}  // namespace drape
