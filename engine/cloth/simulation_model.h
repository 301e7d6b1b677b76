// The whole scene, ready to be simulated. Pure.
#pragma once

#include <string>
#include <vector>

#include "cloth/self_contact.h"
#include "scene/overlap.h"

namespace drape {

/// What contact keeps a cloth's particles from.
struct KeptCollider {
    Collider collider;
    WayOut way_out;
    bool operator==(const KeptCollider&) const = default;
};

struct SimulationModel {
    explicit SimulationModel(const SceneDescription& description, const ModelOptions& options = {});
    /// The same run at another number of substeps; for closed loops.
    SimulationModel(const SimulationModel& run, std::uint32_t substeps);

    SceneDescription scene;     ///< with the settings in use (`auto` is resolved), its colliders sorted by kind
    SolverMethod asked_method;  ///< as the scene file has it
    double asked_tolerance;     ///< that a frame may not miss; 0: none
    SolverChoice choice;
    ModelOptions options;
    std::vector<ClothModel> cloths;
    std::optional<SelfContact> self_contact;  ///< nothing: no cloth meets itself or another
    /// What contact keeps particles from (scene/contact_shape.h): the scene's colliders, once for all cloths that it
    /// grows them alike for and that leave them alike.
    std::vector<std::vector<KeptCollider>> kept_colliders;
    bool windy;
    /// Rounds over all colliders per collision step: one collider cannot overlap another.
    std::uint32_t collision_rounds() const { return scene.colliders.size() > 1 ? 32 : 1; }

    /// The method in use, as a scene knows it.
    const SolverMethodName& method() const { return named(scene.solver.method); }
    /// Whether every frame is judged and done again with other substeps where it fails (cloth/substep_control.h).
    bool closed_loop() const { return asked_method == SolverMethod::automatic && options.closed_loop; }
    /// Largest stretch errors that a closed loop keeps: the scene's, or the defaults.
    struct StretchLimits {
        double rms, worst;
    };
    StretchLimits stretch_limits() const;
    /// That a frame of this run may have: what buffers have room for.
    std::uint32_t most_substeps() const;
    /// Whether iterations end when the tolerance is met.
    bool adaptive() const;
    /// Squared RMS stretch error below which they end: a hundredth under the tolerance, so that what the frame's
    /// statistics sum in another order is within it.
    float iteration_limit() const;
    /// What no cloth of this scene needs, and what each cloth does not need.
    std::vector<SkippedWork> skipped() const;
    /// What the cloths follow only in part.
    std::vector<Compromise> compromises() const;

  private:
    void add_cloths(const std::vector<StartCrossing>& crossed);
    void add_colliders();
};

}  // namespace drape
