// Which passes make a frame, in which order: each method (`relax`, the slides' algorithm outline; `explicit`; `line`)
// as a plain list.
// The device's solver adds one graph pass per step, the C++ twin runs one function per step. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth/cloth_model.h"

namespace drape {

enum class StepKind {
    release,
    wind,
    control,
    predict,
    force,
    explicit_step,
    pin,
    bend,
    twist,
    spring,
    line,
    tether,
    collide,
    check,
    advance
};

struct Step {
    StepKind kind;
    std::uint32_t substep;
    std::uint32_t iteration;  ///< spring, line, collide and check
    std::uint32_t work;       ///< spring, bend, twist, line: index into ClothModel::springs, bends, twists, lines
    bool last = false;        ///< spring, line: of the frame's last iteration, after which its tension is the frame's
    /// Runs only when the check before it found the tolerance not met: decided on the device.
    bool conditional = false;
};

/// The whole scene, ready to be simulated.
struct SimulationModel {
    explicit SimulationModel(const SceneDescription& description, const ModelOptions& options = {});

    SceneDescription scene;     ///< its solver settings are those in use: `auto` is resolved
    SolverMethod asked_method;  ///< as the scene file has it
    double asked_tolerance;     ///< that a frame may not miss; 0: none
    SolverChoice choice;
    std::vector<ClothModel> cloths;
    bool windy;
    int collider_count;
    /// Rounds over all colliders per collision step: one collider cannot overlap another.
    std::uint32_t collision_rounds() const { return collider_count > 1 ? 32 : 1; }

    /// The method in use as a scene spells it.
    std::string method_name() const;
    /// Whether iterations end when the tolerance is met.
    bool adaptive() const;
    /// Squared RMS stretch error below which they end: a hundredth under the tolerance, so that what the frame's
    /// statistics sum in another order is within it.
    float iteration_limit() const;
    /// Steps of one frame of one cloth; at the end X += d. When adaptive, a check follows every iteration but a
    /// substep's last.
    /// relax: per substep release, wind, force, pin motion, bending, then per iteration the springs direction by
    /// direction and parity by parity, and collisions. explicit: per substep release, wind, micro-step, pin motion,
    /// collisions. line: per substep release, wind, control and prediction (with colliders: force), pin motion,
    /// bending, then per iteration the lines of both diagonals, the rows and the columns, and collisions. With tethers
    /// each substep ends with them, and with collisions again.
    std::vector<Step> frame_steps(const ClothModel& cloth) const;
    /// What no cloth of this scene needs, and what each cloth does not need.
    std::vector<SkippedWork> skipped() const;

  private:
    void add_relax_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const;
    /// The iterations of a substep over `work_count` springs or lines, with collisions and checks.
    void add_iterations(StepKind kind, std::uint32_t work_count, std::uint32_t substep, std::vector<Step>& steps) const;
    /// Ends a substep: tethers, and once more the contacts that they may have pulled particles into.
    void add_tethers(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const;
    void add_bend_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const;
    void add_line_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const;
    void add_explicit_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const;
};

}  // namespace drape
