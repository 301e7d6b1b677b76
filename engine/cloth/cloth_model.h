// One cloth of a scene, ready for simulation: its geometry and the constants of the scene's method. The device and the
// C++ twin both start from exactly these floats, and neither changes them; CutTopology holds what a cut changes.
#pragma once

#include "cloth/gas.h"
#include "cloth/method.h"
#include "cloth/solver_choice.h"
#include "shared/residual_types.h"

namespace drape {

struct ModelOptions {
    /// false: do the work of the exact skips (masks of whole cloths, tensions of single iterations), to prove that
    /// skipping changes no bit.
    bool skip = true;
    DeviceKind device = DeviceKind::cpu;  ///< the device for which `auto` chooses, and whose costs decide which steps a
                                          ///< method leaves out
    bool closed_loop = true;              ///< false: method `auto` keeps the substeps that its laws propose
    // What actions may do between frames (drape/ensemble.h):
    bool air = false;     ///< move the air, which is there even if the scene has no wind
    bool weight = false;  ///< change gravity
    bool holds = false;   ///< have pins let go and take again
    bool bodies = false;  ///< push bodies that cloth moves
    bool acts = false;    ///< any of it, so that each frame is done before anything is known of the next
    std::vector<std::size_t> hands = {};  ///< the cloth of each hand
};

/// Contact resolves an overlap that it did not see coming (cloth that starts inside a collider) at this speed, m/s:
/// slow enough to leave little speed and elastic energy behind (a sheet that starts across a ball).
inline constexpr double recovery_speed = 0.1;

/// Returns an estimate of the largest coordinate of the cloth, m.
double largest_coordinate(const Cloth& cloth);

struct ClothModel : ClothGeometry {
    /// The scene's method must be chosen: SimulationModel resolves `auto`.
    ClothModel(const SceneDescription& scene, std::size_t cloth_index, const ModelOptions& options = {});

    double substep_length;  ///< s
    /// The largest length, m, of an edge of the cloth that can meet an edge of a box or a mesh
    /// (shaders/collider_edges.comp). 0: the scene has neither, the cloth's contact is that of particles alone, or its
    /// thickness keeps its edges clear.
    float edge_reach = 0;
    std::size_t member = 0;         ///< which of the model's scenes the cloth belongs to
    std::size_t collider_list = 0;  ///< contact keeps its particles out of this list of SimulationModel::kept_colliders
    std::optional<KeptTurn> turn;   ///< how the cloth turns freely
    MethodScheme scheme;
    std::optional<ClothGas> gas;    ///< nothing: it closes none in
    glsl::WindPush wind;            ///< its member `substep` is set in each substep
    glsl::CollisionPush collision;  ///< its member `first` is set in each substep
    glsl::ResidualPush residual;    ///< constants of the check between iterations
    /// Returns the skin of a particle, including where all particles have the cloth's.
    glsl::vec2 skin_of(std::size_t particle) const {
        return skin.empty() ? glsl::vec2{collision.contact.x, collision.contact.y} : skin[particle];
    }
    /// Returns `collision` with the reach of edges in the place of the thickness.
    glsl::CollisionPush collider_edges() const;

    /// Returns where its particles start, m, row by row.
    std::vector<Vec3> start_places() const;
    /// Lets a force on each particle, N, act from the start on: displacements before it have their half kick.
    void kick(std::span<const Vec3> force);
    /// Returns the displacement of every particle at the start, 0 where pinned, row by row.
    std::vector<glsl::vec4> start_displacement() const;
    /// Returns, for every particle, h times the velocity minus the start displacement.
    std::vector<glsl::vec4> start_excess() const;

  private:
    const glsl::vec4& start_of(std::size_t particle) const {
        return scheme.starts.empty() ? scheme.start : scheme.starts[particle];
    }
    void set_constants(const SceneDescription& scene, const Cloth& cloth, bool air);
};

}  // namespace drape
