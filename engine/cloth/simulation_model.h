#pragma once

#include <string>
#include <vector>

#include "cloth/companions.h"
#include "cloth/mesh_fields.h"
#include "cloth/self_contact.h"
#include "world/overlap.h"

namespace drape {

/// Contact keeps a cloth's particles from this.
struct KeptCollider {
    Collider collider;
    WayOut way_out;
    bool operator==(const KeptCollider&) const = default;
};

struct SimulationModel {
    explicit SimulationModel(const SceneDescription& description, const ModelOptions& options = {});
    /// Makes the same run at another number of substeps, for closed loops.
    SimulationModel(const SimulationModel& run, std::uint32_t substeps);
    /// Puts scenes of one shape beside each other (cloth/members.h): the cloths of the first come first, each called
    /// "<member>/<name>". `scene` is the first one's but for the cloths; nothing of two members meets.
    explicit SimulationModel(const std::vector<const SimulationModel*>& members);

    SceneDescription scene;  ///< the scene with the settings in use (`auto` is resolved), its colliders sorted by kind
    SolverMethod asked_method;  ///< the method that the scene file has
    double asked_tolerance;     ///< no frame may miss it; 0: none
    SolverChoice choice;
    ModelOptions options;
    std::vector<ClothModel> cloths;
    std::optional<SelfContact> self_contact;  ///< nothing: no cloth meets itself or another
    /// Contact keeps particles from these (world/contact_shape.h): the scene's colliders, once for all cloths that it
    /// grows them alike for and that leave them alike.
    std::vector<std::vector<KeptCollider>> kept_colliders;
    MeshFields mesh_fields;  ///< distances to the colliders that are meshes
    bool windy;              ///< substeps have a wind pass: wind blows, actions may make it blow, or gravity changes
    bool weighs;             ///< the wind pass also adds what gravity is more than at the start
    bool colliders_move = false;   ///< some collider is key-framed: each substep has records of its own
    std::size_t member_count = 1;  ///< scenes that the cloths are of (ClothModel::member)
    /// Returns the rounds over all colliders per collision step: one collider cannot overlap another.
    std::uint32_t collision_rounds() const { return scene.colliders.size() > 1 ? 32 : 1; }

    /// Returns the method in use, as a scene knows it.
    const SolverMethodName& method() const { return named(scene.solver.method); }
    /// Returns whether frames are judged and done again with other substeps where they fail
    /// (control/substep_control.h).
    bool closed_loop() const { return asked_method == SolverMethod::automatic && options.closed_loop; }
    /// Returns whether the position error is estimated (control/motion_error.h).
    bool has_companions() const { return scene.solver.estimate_error.value_or(closed_loop()); }
    /// Returns whether states are held against each other, or change their substeps.
    bool compares_states() const { return closed_loop() || has_companions(); }
    std::uint32_t companion_substeps(std::uint32_t substeps) const;
    /// A closed loop keeps these largest stretch errors: the scene's, or the defaults.
    struct StretchLimits {
        double rms, worst;
    };
    StretchLimits stretch_limits() const;
    /// Returns how many substeps a frame of this run may have: buffers have room for them.
    std::uint32_t most_substeps() const;
    /// Returns whether iterations end when the tolerance is met. Where they are cheaper than to ask, all are done.
    bool adaptive() const;
    /// Returns the squared RMS stretch error below which they end: a hundredth under the tolerance, so that the frame's
    /// statistics, which sum in another order, are within it.
    float iteration_limit() const;
    /// Returns what no cloth of this scene needs, and what each cloth does not need.
    std::vector<SkippedWork> skipped() const;
    /// Returns what the cloths follow only in part.
    std::vector<Compromise> compromises() const;

  private:
    bool ends_iterations() const;
    bool iterates_cheaply() const;
    void add_cloths(const std::vector<StartCrossing>& crossed);
    void add_colliders();
};

}  // namespace drape
