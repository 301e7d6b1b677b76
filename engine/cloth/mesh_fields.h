// The distances to a scene's meshes, in the form that devices read.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "drape/compromise.h"
#include "drape/scene.h"
#include "mesh/form_lists.h"
#include "shared/collider_types.h"

namespace drape {

class MeshFields {
  public:
    MeshFields() = default;
    /// Takes the colliders of a scene, sorted by kind. Throws Error where all fields together are too large, or a mesh
    /// was not read.
    explicit MeshFields(const SceneDescription& scene);

    bool empty() const { return !texels_; }
    /// Returns whether some mesh deforms, so that each frame has texels of its own.
    bool deform() const { return forms_ != nullptr; }
    /// Returns the fields as texels (shared/collider_types.h). Those of meshes that deform have no samples: passes
    /// compute them for every frame (shared/form_types.h).
    const std::vector<glsl::vec4>& texels() const { return *texels_; }
    const std::shared_ptr<const std::vector<glsl::vec4>>& shared_texels() const { return texels_; }
    const glsl::vec4* data() const { return texels_ ? texels_->data() : nullptr; }
    /// Returns what those passes need for a frame between two times, s; null where no mesh deforms. Forms that are the
    /// same as in the last frames asked for are not computed again.
    std::shared_ptr<const FormLists> forms(double from, double to) const;
    /// Returns the push constants of those passes, one for each mesh.
    std::vector<glsl::FormPush> form_pushes(std::uint32_t substeps) const;
    /// Returns the first texel of a collider's field; 0 for a collider that is no mesh.
    std::size_t first(std::size_t collider) const { return collider < first_.size() ? first_[collider] : 0; }
    /// Returns where fields are too coarse for their meshes. `scene`: the one that the fields were made from.
    std::vector<Compromise> compromises(const SceneDescription& scene) const;

  private:
    struct FieldSpacing {
        std::size_t collider;    ///< index in the scene's list, which is sorted by kind
        double wanted, spacing;  ///< m
        double thickness;        ///< m: of the body's thickest part, or that of a shell
        bool has_room;           ///< a field with a quarter of this thickness as its spacing has few enough points
    };

    class Forms;

    std::shared_ptr<const std::vector<glsl::vec4>> texels_;
    std::shared_ptr<Forms> forms_;  ///< of meshes that deform; null: there are none
    std::vector<std::size_t> first_;
    std::vector<FieldSpacing> spacings_;
};

}  // namespace drape
