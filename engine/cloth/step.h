// A frame is made of steps, each a kind and the constants that its pass gets. The device's solver adds graph passes per
// step, and the C++ twin runs one function per step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "drape/kernels.h"
#include "shared/bend_types.h"
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"

namespace drape {

/// The default device breaks off, unseen, after some 65,535 rounds of loops of an invocation (docs/devices.md).
inline constexpr std::size_t most_loop_rounds = 60000;

enum class StepKind {
    stiffness,
    release,
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
    tether,
    collider_edges,
    collide,
    residual,
    decide,
    advance,
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
    self_limit,
    self_return,
};
inline constexpr std::size_t step_kind_count = static_cast<std::size_t>(StepKind::self_return) + 1;

/// The push structure of a step whose constants are its method's own. `SpringPush::first_iteration` is set per
/// iteration.
using StepConstants =
    std::variant<std::monostate, glsl::ForcePush, glsl::PredictPush, glsl::ExplicitPush, glsl::BendTargetPush,
                 glsl::BendPush, glsl::TwistPush, glsl::AllTwistPush, glsl::SpringPush, glsl::AllSpringsPush,
                 glsl::LinePush, glsl::NestedPush, glsl::SelfContactPush, glsl::SelfClothPush>;

/// A step as a method plans it, for any substep.
struct MethodStep {
    StepKind kind;
    StepConstants constants;
};

/// `Step::cloth` has the first value where the step is taken for every cloth of the scene, and the second where it is
/// one of contact, taken once for all of them.
inline constexpr std::size_t all_cloths = static_cast<std::size_t>(-1), between_cloths = all_cloths - 1;

struct Step {
    StepKind kind;
    std::size_t cloth;
    std::uint32_t substep;
    std::uint32_t iteration = 0;
    StepConstants constants{};
    /// It belongs to the frame's last substep; a spring or line step also to that substep's last iteration, after which
    /// its tension is the frame's.
    bool last = false;
    /// An explicit step takes so many substeps at once, from `substep` on.
    std::uint32_t count = 1;
    /// It runs only when the decision before it was that the tolerance is not met; the device decides.
    bool conditional = false;
    /// A collision, or a second `collider_edges`, goes on from what `collider_edges` left.
    bool after_edges = false;
    /// A collision keeps the surfaces that particles lie on.
    bool supporting = false;
    /// A collision leads particles out of overlaps: one of each substep does.
    bool leading = false;
    /// A collision ends a substep after contact between cloths, on whose sheet it finds and leaves displacements too.
    bool after_impulses = false;
    /// A prediction writes the displacement to its spare image, from where an odd number of joined steps brings it
    /// back. A step of all springs that carry tension writes it to the spare images, from where the next one brings it
    /// back.
    bool turns = false;
    /// The kernel of its row that runs it (cloth/kernel_steps.h).
    Kernel kernel = Kernel::plain;
    /// Invocations of a subgroup where that has parts of a step's lines, else 0.
    std::uint32_t subgroup = 0;
    /// It is taken at once for all cloths that are simulated together with `cloth` (cloth/together.h).
    bool together = false;
    /// The constants of each of those; none: all have the same.
    std::vector<StepConstants> own{};

    /// Returns the step's constants. Throws std::bad_variant_access when they are not a `Push`.
    template <class Push>
    const Push& push() const {
        return std::get<Push>(constants);
    }
};

}  // namespace drape
