// Pictures show these beside cloth: the scene's colliders and its fixtures.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "drape/frame.h"
#include "drape/scene.h"
#include "picture/collider_mesh.h"
#include "picture/fixtures.h"
#include "picture/raster_frame.h"

namespace drape {

class DrawnBodies {
  public:
    /// `left_out`: the collider that is not drawn as a body, if there is one.
    DrawnBodies(const SceneDescription& scene, std::optional<std::size_t> left_out);

    const std::vector<Collider>& colliders() const { return colliders_; }
    std::size_t count() const { return colliders_.size() + fixtures_.size(); }
    /// Returns the colliders and then the fixtures at `time` (s). `moved`: where bodies that cloth moves are.
    std::vector<Collider> at(double time, std::span<const BodyState> moved = {}) const;
    /// Returns their ids in layers (LayerPixel::id), in the same order, of a scene of so many cloths.
    std::vector<std::uint16_t> ids(std::size_t cloth_count) const;
    /// Returns the columns for the largest bodies of each kind, examined at some times until `end` (s).
    RoundColumns columns(const FrameView& view, double end, std::uint32_t height) const;

    /// Returns whether some mesh deforms: its corners are told for every frame.
    bool deform() const { return deform_; }
    /// Returns the corners of meshes, where some deforms those of the start.
    const std::vector<glsl::MeshCorner>& corners() const { return corners_; }
    std::vector<glsl::MeshCorner> corners_at(double time) const { return mesh_corners(colliders_, time); }

  private:
    std::vector<Collider> colliders_;
    std::optional<std::size_t> left_out_;
    std::vector<Fixture> fixtures_;
    std::vector<glsl::MeshCorner> corners_;
    bool deform_;
};

}  // namespace drape
