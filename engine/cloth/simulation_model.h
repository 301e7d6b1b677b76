#pragma once

#include <string>
#include <vector>

#include "cloth/bodies.h"
#include "cloth/companions.h"
#include "cloth/mesh_fields.h"
#include "cloth/self_contact.h"
#include "world/overlap.h"

namespace drape {

/// A shape that contact keeps a cloth's particles out of.
struct KeptCollider {
    Collider collider;
    WayOut way_out;
    bool operator==(const KeptCollider&) const = default;
};

struct SimulationModel {
    explicit SimulationModel(const SceneDescription& description, const ModelOptions& options = {});
    /// Makes a copy of the model with another number of substeps, for closed loops.
    SimulationModel(const SimulationModel& run, std::uint32_t substeps);
    /// Joins scenes of one shape (cloth/members.h): the cloths of the first come first, each named "<member>/<name>".
    /// `scene` is the first one's with all cloths. Cloths of two members never touch.
    explicit SimulationModel(const std::vector<const SimulationModel*>& members);
    /// Takes over what actions have changed in another model of the same scene.
    void take_actions(const SimulationModel& acted);

    SceneDescription
        scene;  ///< the scene with the settings in use (`auto` is resolved) and its colliders sorted by kind
    SolverMethod asked_method;  ///< the method that the scene file names
    double asked_tolerance;     ///< the tolerance that no frame may miss; 0: none
    SolverChoice choice;
    ModelOptions options;
    std::vector<ClothModel> cloths;
    std::optional<SelfContact> self_contact;  ///< nothing: no cloth can touch itself or another
    /// The shapes that contact keeps particles out of (world/contact_shape.h): the scene's colliders, in one list for
    /// all cloths that need the same shapes and leave them the same way.
    std::vector<std::vector<KeptCollider>> kept_colliders;
    std::vector<MemberBodies> bodies;  ///< by member
    MeshFields mesh_fields;            ///< distances to the colliders that are meshes
    bool windy;   ///< substeps have a wind pass: wind blows, actions may make it blow, or gravity changes
    bool weighs;  ///< the wind pass also adds the change of gravity since the start
    bool colliders_move = false;    ///< some collider is key-framed, so each substep has records of its own
    std::size_t member_count = 1;   ///< the number of scenes that the cloths belong to (ClothModel::member)
    std::size_t sewn_count = 0;     ///< the number of places at which cloths are sewn (ClothModel::sewn)
    std::size_t gas_sum_count = 0;  ///< the number of sums that gas follows from (ClothModel::gas)
    std::vector<double> closings;   ///< s: closing_times
    /// Returns the rounds over all colliders in a collision step; a single collider needs one, since it overlaps no
    /// other.
    std::uint32_t collision_rounds() const { return scene.colliders.size() > 1 ? 32 : 1; }

    /// Returns the method in use, as scene files name it.
    const SolverMethodName& method() const { return named(scene.solver.method); }
    /// Returns whether frames are judged, and done again with other substeps where they fail
    /// (control/substep_control.h).
    bool closed_loop() const { return asked_method == SolverMethod::automatic && options.closed_loop; }
    /// Returns whether the position error is estimated (control/motion_error.h).
    bool has_companions() const { return scene.solver.estimate_error.value_or(closed_loop()); }
    /// Returns whether states are compared with each other, or change their substeps.
    bool compares_states() const { return closed_loop() || has_companions(); }
    std::uint32_t companion_substeps(std::uint32_t substeps) const;
    /// The largest stretch errors that a closed loop keeps: the scene's, or the defaults.
    struct StretchLimits {
        double rms, worst;
    };
    StretchLimits stretch_limits() const;
    /// Returns the largest number of substeps that a frame of this run may have, for which buffers have room.
    std::uint32_t most_substeps() const;
    /// Returns whether iterations end when the tolerance is met. Where iterating is cheaper than checking, all
    /// iterations are done.
    bool adaptive() const;
    /// Returns the squared RMS stretch error below which iterations end: a hundredth less than the tolerance, so that
    /// the frame's statistics, which sum in another order, are within it.
    float iteration_limit() const;
    /// Returns what no cloth of this scene needs, and what each cloth does not need.
    std::vector<SkippedWork> skipped() const;
    /// Returns the compromises that the cloths' methods make.
    std::vector<Compromise> compromises() const;

  private:
    bool ends_iterations() const;
    bool iterates_cheaply() const;
    void add_cloths(const std::vector<StartCrossing>& crossed);
    void share_kicks();
    void add_colliders();
};

}  // namespace drape
