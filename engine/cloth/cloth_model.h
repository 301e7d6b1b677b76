// One cloth of a scene is ready to be simulated: its geometry and what the scene's method makes of it. Both the device
// and the C++ twin start from exactly these floats, and neither changes them: CutTopology has what a cut changes.
#pragma once

#include "cloth/method.h"
#include "cloth/solver_choice.h"
#include "shared/residual_types.h"

namespace drape {

struct ModelOptions {
    /// false keeps the exact skips' work (masks of whole cloths, tensions of single iterations) to prove that skipping
    /// changes no bit.
    bool skip = true;
    DeviceKind device = DeviceKind::cpu;  ///< for this `auto` chooses, and methods leave out what others do cheaper
    bool closed_loop = true;              ///< false: method `auto` keeps the substeps that its laws propose
    bool air = false;                     ///< there is air though the scene has no wind: an ensemble's actions move it
};

/// Contact resolves an overlap that it did not see coming (cloth that starts inside a collider) at this speed, m/s:
/// slow enough to leave little speed and elastic energy behind (a sheet that starts across a ball).
inline constexpr double recovery_speed = 0.1;

/// Returns the largest coordinate that the cloth is expected to have, m.
double largest_coordinate(const Cloth& cloth);

struct ClothModel : ClothGeometry {
    /// The scene's method must be chosen: SimulationModel resolves `auto`.
    ClothModel(const SceneDescription& scene, std::size_t cloth_index, const ModelOptions& options = {});

    double substep_length;  ///< s
    /// An edge of the cloth is at most so long, m, where it can meet that of a box or a mesh
    /// (shaders/collider_edges.comp). 0: the scene has neither, the cloth's contact is of particles, or its thickness
    /// keeps everything clear.
    float edge_reach = 0;
    std::size_t member = 0;         ///< number of its scene among those of the model
    std::size_t collider_list = 0;  ///< its particles are kept from this list of SimulationModel::kept_colliders
    MethodScheme scheme;
    glsl::WindPush wind;            ///< substep is set per substep
    glsl::CollisionPush collision;  ///< first is set per substep
    glsl::ResidualPush residual;    ///< constants of the check between iterations
    /// Returns the skin of a particle, where all have the cloth's too.
    glsl::vec2 skin_of(std::size_t particle) const {
        return skin.empty() ? glsl::vec2{collision.contact.x, collision.contact.y} : skin[particle];
    }
    /// Returns `collision` with the reach of edges for the thickness.
    glsl::CollisionPush collider_edges() const;

    /// Returns the displacement of every particle at the start, 0 where pinned, row by row.
    std::vector<glsl::vec4> start_displacement() const;
    /// Returns h times the velocity, less that displacement.
    std::vector<glsl::vec4> start_excess() const;

  private:
    const glsl::vec4& start_of(std::size_t particle) const {
        return scheme.starts.empty() ? scheme.start : scheme.starts[particle];
    }
    void set_constants(const SceneDescription& scene, const Cloth& cloth, bool air);
};

}  // namespace drape
