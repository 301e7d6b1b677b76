// One cloth of a scene as numbers: initial images, masks, spring constants, pins. Both the device and the C++
// twin start from exactly these floats. Pure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cloth/directions.h"
#include "cloth/grid.h"
#include "cloth/line_constants.h"
#include "cloth/solver_choice.h"
#include "cloth/stiffness_constants.h"
#include "cloth/tethers.h"
#include "scene/scene_description.h"
#include "shared/residual_types.h"
#include "shared/simulation_types.h"

namespace drape {

/// Something that a scene does not need and therefore does not get.
struct SkippedWork {
    std::string what, reason;
};

struct ModelOptions {
    /// false: keep the exact skips' work (empty parities, masks of whole cloths, tensions of single
    /// iterations) to prove that skipping changes no bit.
    bool skip = true;
    DeviceKind device = DeviceKind::cpu;  ///< what method `auto` chooses for
};

/// One parity pass with its constants.
struct SpringWork {
    SpringPass pass;
    glsl::SpringPush push;  ///< first_iteration is set per iteration
};

/// One colour of one axis of bending elements with its constants.
struct BendWork {
    BendPass pass;
    glsl::BendPush push;
};

/// The twist of one colour of the cells with its constants.
struct TwistWork {
    TwistPass pass;
    glsl::TwistPush push;
};

/// A pin that moves or lets go; pins at rest for ever are just w = 0.
struct DynamicPin {
    MotionPath path;
    Vec3 pivot;                     ///< m
    std::optional<double> release;  ///< s
};

struct ClothModel {
    ClothModel(const SceneDescription& scene, std::size_t cloth_index, const ModelOptions& options = {});

    /// Makes the stiffness image exist, with the shares of the grid as it is now; does nothing the second time.
    void make_masked();
    /// Lets go of every tether: what was cut off no longer hangs on what holds the rest.
    void drop_tethers();

    std::string name;
    Grid grid;
    double spacing[2];                      ///< m along columns, rows
    double inner_mass;                      ///< kg of a particle with four cells
    double substep_length;                  ///< s
    StiffnessConstants stiffness_constant;  ///< what the scene asks for
    bool second_order = false;              ///< line: BDF2; without it (colliders) backward Euler
    double used_bend = 0;                   ///< N m that the solver applies
    std::array<double, 4> used_stiffness;   ///< N/m that the solver applies per direction, away from borders; relax:
                                            ///< infinite when rigid

    // Initial images, one texel per particle, row by row.
    std::vector<glsl::vec4> position;      ///< xyz m; w: relative inverse mass, 0 = pinned or without a cell
    std::vector<glsl::vec4> displacement;  ///< xyz: x(0) - x(-h), the half-kick start; line in second order: h v(0);
                                           ///< 0 where pinned
    std::vector<float> free_weight;        ///< w without pins

    bool masked = false;                ///< holes: stiffness and cell images exist
    std::vector<glsl::vec4> stiffness;  ///< when masked: share per direction, by first particle
    bool carries_tension[4] =
        {};  ///< relax, line: direction's tension goes from iteration to iteration: compliant, iterated

    std::vector<SpringWork> springs;  ///< relax: in order of relaxation, needless ones left out
    std::vector<BendWork> bends;      ///< relax, line: likewise, once per substep before the springs
    std::vector<TwistWork> twists;    ///< likewise, after the bends
    std::vector<LineWork> lines;      ///< line: in order of solution
    std::vector<DynamicPin> dynamic_pins;
    std::vector<glsl::PinnedParticle> pinned;  ///< particles of the dynamic pins
    bool has_release = false, has_motion = false;
    std::vector<glsl::ParticleTethers> tethers;  ///< with tethers and pins: of every particle

    bool gathers = false;                    ///< explicit: particles gather what their springs do
    glsl::ForcePush force;                   ///< relax, and line in first order
    glsl::PredictPush predict{};             ///< line in second order
    glsl::ExplicitPush explicit_step{};      ///< explicit
    ExplicitStiffness explicit_stiffness{};  ///< explicit: what the step uses of the stiffness
    glsl::TensionPush tension{};             ///< explicit
    glsl::WindPush wind;                     ///< substep is set per substep
    glsl::CollisionPush collision;           ///< first is set per substep
    glsl::ResidualPush residual;             ///< of the check between iterations
    std::vector<SkippedWork> skipped;

  private:
    void place(const Cloth& cloth, const Vec3& gravity);
    void set_tethers(const SceneDescription& scene, const Cloth& cloth);
    void note_tension(const Cloth& cloth);
    void hold_pins(const Cloth& cloth);
    void add_springs(const Cloth& cloth, std::uint32_t iterations, const ModelOptions& options);
    void add_bends(std::uint32_t substeps, const LineSettings& settings);
    void set_lines(const SceneDescription& scene, const Cloth& cloth, const ModelOptions& options);
    LineSettings line_settings(const Cloth& cloth) const;
    void set_explicit(const SceneDescription& scene, const Cloth& cloth);
    void set_constants(const SceneDescription& scene, const Cloth& cloth);
};

}  // namespace drape
