// One cloth of a scene, ready to be simulated: its geometry and what the scene's method makes of it. Both the device
// and the C++ twin start from exactly these floats, and neither changes them: what a cut changes is in CutTopology.
// Pure.
#pragma once

#include "cloth/method.h"
#include "cloth/solver_choice.h"
#include "shared/residual_types.h"

namespace drape {

struct ModelOptions {
    /// false: keep the exact skips' work (masks of whole cloths, tensions of single iterations) to prove that skipping
    /// changes no bit.
    bool skip = true;
    DeviceKind device = DeviceKind::cpu;  ///< what method `auto` chooses for
    bool closed_loop = true;              ///< false: method `auto` keeps the substeps that its laws propose
};

/// At which contact resolves an overlap that it did not see coming (cloth that starts inside a collider), m/s: slow
/// enough to leave little speed and elastic energy behind (a sheet that starts across a ball).
inline constexpr double recovery_speed = 0.1;

/// m, that the cloth is expected to have.
double largest_coordinate(const Cloth& cloth);

struct ClothModel : ClothGeometry {
    /// The scene's method must be chosen: `auto` is resolved by SimulationModel.
    ClothModel(const SceneDescription& scene, std::size_t cloth_index, const ModelOptions& options = {});

    double substep_length;  ///< s
    bool collides;          ///< with colliders of the scene
    /// m, of an edge of the cloth at most: where it can meet that of a box (shaders/box_edges.comp). 0: the scene has
    /// no box, the cloth's contact is of particles, or its thickness keeps everything clear.
    float edge_reach = 0;
    std::size_t collider_list = 0;  ///< of SimulationModel::kept_colliders: what its particles are kept from
    MethodPlan plan;
    glsl::WindPush wind;            ///< substep is set per substep
    glsl::CollisionPush collision;  ///< first is set per substep
    glsl::ResidualPush residual;    ///< of the check between iterations
    /// `collision` with the reach of edges for the thickness.
    glsl::CollisionPush box_edges() const;

    /// Of every particle at the start, 0 where pinned: row by row.
    std::vector<glsl::vec4> start_displacement() const;
    /// h times the velocity - that displacement.
    std::vector<glsl::vec4> start_excess() const;

  private:
    void set_constants(const SceneDescription& scene, const Cloth& cloth);
};

}  // namespace drape
