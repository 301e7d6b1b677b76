// A frame is a list of steps, each a kind and the constants of its pass. The device's solver adds graph passes for each
// step, and the C++ twin calls one function for each step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "drape/kernels.h"
#include "shared/bend_types.h"
#include "shared/body_types.h"
#include "shared/gas_types.h"
#include "shared/impulse_types.h"
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "shared/rotation_types.h"
#include "shared/seam_types.h"
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"

namespace drape {

/// The default device silently breaks off a shader after some 65,535 rounds of loops in an invocation
/// (docs/devices.md).
inline constexpr std::size_t most_loop_rounds = 60000;

enum class StepKind {
    stiffness,
    release,
    gas_area,
    gas_sum,
    gas_pressure,
    wind,
    predict,
    force,
    explicit_step,
    pin,
    bend_targets,
    bend_pulls,
    bend,
    twist,
    all_twist,
    spring,
    all_springs,
    line,
    nested,
    torque,
    rotate,
    tether,
    seam_give,
    seam_take,
    collider_edges,
    collide,
    residual,
    decide,
    advance,
    clear_impulses,
    body_meet,
    body_move,
    body_strike,
    momentum,
    worst_impulses,
    self_gather,
    self_boxes,
    self_tree,
    self_blocks,
    self_near,
    self_crossings,
    self_apart,
    self_primitives,
    self_pairs,
    self_begin,
    self_contact,
    self_push,
    self_impulses,
    self_limit,
    self_return,
    self_couples,
    self_turn,
    self_sew,
};
inline constexpr std::size_t step_kind_count = static_cast<std::size_t>(StepKind::self_sew) + 1;

/// The push structure of a step whose constants depend on the method. `SpringPush::first_iteration` is set in each
/// iteration.
using StepConstants =
    std::variant<std::monostate, glsl::ForcePush, glsl::PredictPush, glsl::ExplicitPush, glsl::BendTargetPush,
                 glsl::BendPush, glsl::TwistPush, glsl::AllTwistPush, glsl::SpringPush, glsl::AllSpringsPush,
                 glsl::LinePush, glsl::NestedPush, glsl::RotationPush, glsl::SelfContactPush, glsl::SelfClothPush,
                 glsl::ContactTurnPush, glsl::ClearImpulsesPush, glsl::WorstImpulsesPush, glsl::MomentumPush,
                 glsl::BodyMovePush, glsl::BodyStrikePush, glsl::SeamPush, glsl::GasAreaPush, glsl::GasSumPush,
                 glsl::GasPush>;

/// A step as a method plans it, the same for every substep.
struct MethodStep {
    StepKind kind;
    StepConstants constants;
};

/// `Step::cloth` has the first value in a step for every cloth of the scene, and the second in a step of contact
/// between cloths, which is taken once for all of them.
inline constexpr std::size_t all_cloths = static_cast<std::size_t>(-1), between_cloths = all_cloths - 1;

struct Step {
    StepKind kind;
    std::size_t cloth;
    std::uint32_t substep;
    std::uint32_t iteration = 0;
    StepConstants constants{};
    /// The step belongs to the frame's last substep. A spring or line step also belongs to that substep's last
    /// iteration, after which its tension is the frame's.
    bool last = false;
    /// The number of substeps, from `substep` on, that an explicit step takes at once.
    std::uint32_t count = 1;
    /// The step runs only if the decision before it was that the tolerance is not met yet; the device decides.
    bool conditional = false;
    /// A collision, or a second `collider_edges`, starts from what the first `collider_edges` left.
    bool after_edges = false;
    /// A collision stores the surfaces on which particles lie.
    bool supporting = false;
    /// A collision leads particles out of overlaps: one collision of each substep does.
    bool leading = false;
    /// A collision ends a substep after contact between cloths; it reads displacements from their sheet and writes them
    /// there too.
    bool after_impulses = false;
    /// A step of contact between cloths finds impulses for the motions of the substep before.
    bool looks_back = false;
    /// A prediction writes the displacement to its spare image, from which an odd number of joined steps brings it
    /// back. A step of all springs that carry tension writes the tension to the spare images, from which the next one
    /// brings it back.
    bool turns = false;
    /// Which of the kernels of its row runs the step (cloth/kernel_steps.h).
    Kernel kernel = Kernel::plain;
    /// Number of invocations in a subgroup, if subgroups solve parts of the step's lines; otherwise 0.
    std::uint32_t subgroup = 0;
    /// The step is taken at once for all cloths that are simulated together with `cloth` (cloth/together.h).
    bool together = false;
    /// The constants of each of those cloths; empty: all have the same.
    std::vector<StepConstants> own{};

    /// Returns the step's constants. Throws std::bad_variant_access when they are not a `Push`.
    template <class Push>
    const Push& push() const {
        return std::get<Push>(constants);
    }
    /// Returns whether the step is one of the bodies of its cloth's member. No step moves past it.
    bool is_of_bodies() const {
        return kind == StepKind::body_meet || kind == StepKind::body_move || kind == StepKind::body_strike;
    }
};

}  // namespace drape
