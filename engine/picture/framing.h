// Finds the extent of a scene, and a camera for a scene that names none.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "drape/frame.h"
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

/// Finds the nearest place from which a camera of a given direction and angle shows all that it was told, with a tenth
/// of the picture's half around it. Only a few supporting planes of all points decide: it keeps no point.
class Framing {
  public:
    /// Looks as the scene's camera does at the start or, without one, from the right, the front and above.
    /// `aspect`: the picture's width over its height.
    Framing(const SceneDescription& scene, double aspect);

    void add(const Vec3& point);
    /// Adds a bounded collider as it is at a time, s.
    void add(const Collider& collider, double time);
    /// Adds a frame's cloths, and the bounded colliders as they are then.
    void add(const SceneDescription& scene, const FinishedFrame& frame);
    /// Returns that camera, its target amid what it shows; nothing: it was told nothing.
    std::optional<Camera> camera() const;

  private:
    /// Returns the normals of the planes that bound what a camera at the origin sees, outwards and times the cosine of
    /// their angle with the direction: at the right, left, top and bottom; and the direction and its opposite.
    std::array<Vec3, 6> directions() const;

    Vec3 right_, up_, forward_;
    double half_wide_, half_high_, fov_;  ///< tangents; degrees
    /// The largest product of any point with each of the directions, m.
    std::array<double, 6> reach_;
};

/// Returns the scene's camera; without one, a camera that looks from the right, the front and above at its colliders
/// and at its cloths where they start, hang and land, as near as keeps all of them in the picture, whatever its shape.
Camera picture_camera(const SceneDescription& scene, std::uint32_t width, std::uint32_t height);

}  // namespace drape
