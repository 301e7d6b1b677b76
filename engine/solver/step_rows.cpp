#include <fmt/format.h>

#include <stdexcept>

#include "cloth/directions.h"
#include "cloth/kernel_steps.h"
#include "solver/step_size.h"

namespace drape {

namespace {

using Place = const StepPlace&;

template <class Push>
std::size_t channel_of(Place p) {
    return static_cast<std::size_t>(p.step.push<Push>().channel);
}
const MethodScheme& scheme_of(Place p) { return p.cloth->model->scheme; }
bool has(Place p, Field field) { return (*p.cloth)[field].valid(); }

// The variants of the shaders stand for these.
bool masked(Place p) { return p.cloth->masked(); }
bool buffered(Place p) { return p.cloth->buffered; }
bool windy(Place p) { return has(p, Field::wind_force); }
bool second_order(Place p) { return scheme_of(p).second_order; }
bool after_edges(Place p) { return p.step.after_edges; }
bool after_impulses(Place p) { return p.step.after_impulses; }
bool meets_meshes(Place p) { return !p.model.mesh_fields.empty(); }
/// Few scenes have meshes, which move few particles: modules that store these through buffers would not pay.
bool collides_buffered(Place p) { return buffered(p) && !meets_meshes(p); }
bool supporting(Place p) { return p.step.supporting && !p.step.after_impulses; }
bool keeps_excess(Place p) { return has(p, Field::end_excess); }
bool comes_home(Place p) { return p.cloth->away; }
bool control_comes_home(Place p) { return second_order(p) && p.step.substep % 2 == 1; }
bool keeps_before(Place p) { return p.step.last && has(p, Field::displacement_before); }
bool carries_to_release(Place p) { return scheme_of(p).release_stiffness.x > 0; }
bool releases_tension(Place p) { return carries_to_release(p) && !masked(p); }
bool releases_masked_tension(Place p) { return carries_to_release(p) && masked(p); }
bool bends(Place p) { return p.step.push<glsl::LinePush>().bend > 0; }
bool shears(Place p) { return p.step.push<glsl::NestedPush>().rest_length.z > 0; }
bool stores_spring_tension(Place p) {
    const std::size_t direction = channel_of<glsl::SpringPush>(p);
    return has(p, tension_of(direction)) &&
           (scheme_of(p).carries_tension[direction] || (p.step.last && p.step.push<glsl::SpringPush>().compliance > 0));
}
bool carries_tension(Place p) { return scheme_of(p).carries_tension[0]; }
/// All springs of an iteration: only the stretch springs' tension is stored, for the stretch error.
bool stores_stretch_tension(Place p) {
    return !carries_tension(p) && p.step.last && has(p, Field::tension_row) &&
           p.step.push<glsl::AllSpringsPush>().compliance.x > 0;
}
std::string spring_label(Place p) {
    const auto& push = p.step.push<glsl::SpringPush>();
    return fmt::format("spring {} {}", spring_directions[static_cast<std::size_t>(push.channel)].name,
                       push.parity == 0 ? "even" : "odd");
}
std::string bend_label(Place p) {
    const auto& push = p.step.push<glsl::BendPush>();
    return fmt::format("bend {} {}", bend_axes[static_cast<std::size_t>(push.channel)].name, push.colour);
}
std::string twist_label(Place p) {
    const auto& push = p.step.push<glsl::TwistPush>();
    return fmt::format("twist {} {}", push.first.x, push.first.y);
}
std::string line_label(Place p) {
    return fmt::format("line {}", spring_directions[channel_of<glsl::LinePush>(p)].name);
}
std::string explicit_label(Place p) {
    return p.step.count > 1 ? fmt::format("{} explicit steps", p.step.count) : "explicit step";
}
std::string collider_edges_label(Place p) { return p.step.after_edges ? "collider edges again" : "collider edges"; }

graph::PushConstants wind_push(Place p) {
    glsl::WindPush push = p.cloth->model->wind;
    push.substep = static_cast<int>(p.step.substep);
    push.first = static_cast<int>(p.cloth->model->member * p.model.scene.solver.substeps);
    return push;
}
glsl::PinPush pins_of(Place p) {
    return {static_cast<int>(p.cloth->pinned_count), static_cast<int>(p.step.substep * p.cloth->pin_count),
            static_cast<int>(p.cloth->model->grid.rows())};
}
graph::PushConstants pin_push(Place p) { return pins_of(p); }
graph::PushConstants release_push(Place p) {
    const glsl::PinPush pins = pins_of(p);
    return glsl::ReleasePush{scheme_of(p).release_stiffness,
                             p.cloth->model->grid.size(),
                             pins.particle_count,
                             pins.motion_first,
                             p.cloth->model->reach(),
                             0,
                             0,
                             0};
}
graph::PushConstants stiffness_push(Place p) {
    return glsl::StiffnessPush{p.cloth->model->grid.size(), static_cast<int>(p.step.cloth), 0};
}
graph::PushConstants grid_push(Place p) { return glsl::GridPush{p.cloth->model->grid.size()}; }
graph::PushConstants spring_push(Place p) {
    glsl::SpringPush push = p.step.push<glsl::SpringPush>();
    push.first_iteration = p.step.iteration == 0 ? 1 : 0;
    return push;
}
graph::PushConstants contact_push(Place p, glsl::CollisionPush push) {
    push.list = first_collider(p.model, *p.cloth->model, 0);
    push.first = first_collider(p.model, *p.cloth->model, p.step.substep) - push.list;
    return push;
}
graph::PushConstants collision_push(Place p) {
    glsl::CollisionPush push = p.cloth->model->collision;
    if (p.step.after_impulses) {
        const auto& laid = p.step.push<glsl::SelfClothPush>();
        push.laid = laid.first;
        push.sheet_columns = laid.sheet.x;
    }
    if (!p.step.leading) push.contact.w = 0;
    return contact_push(p, push);
}
graph::PushConstants collider_edges_push(Place p) { return contact_push(p, p.cloth->model->collider_edges()); }
graph::PushConstants residual_push(Place p) { return p.cloth->model->residual; }
graph::PushConstants decide_push(Place p) {
    return glsl::IterationPush{static_cast<int>(residual_count(p.cloth->model->grid)), p.model.iteration_limit(),
                               p.step.substep == 0 && p.step.iteration == 0 ? 1 : 0,
                               static_cast<int>(p.model.scene.solver.substeps)};
}

Turn turns_displacement(Place) { return Turn::displacement; }
Turn turns_state(Place) { return Turn::state; }
Turn turns_if_asked(Place p) { return p.step.turns ? Turn::displacement : Turn::nothing; }
Turn turns_home(Place p) { return p.cloth->away ? Turn::state : Turn::nothing; }

std::string variable_of(Field field) { return row_of(field).variable(); }
/// The name `tension` means the tension of the step's direction.
template <class Push>
std::string tension_alias(Place p, std::string_view name, bool) {
    return name == "tension" ? variable_of(tension_of(channel_of<Push>(p))) : std::string();
}
/// A step of all springs reads one set of tensions and writes the other, so that the substep's last one writes where
/// the tension is looked for. The first one reads where the state is.
std::string all_springs_alias(Place p, std::string_view name, bool written) {
    if (!name.starts_with("tension")) return {};
    const bool spare = written ? p.step.turns : !p.step.turns && p.step.iteration > 0;
    return std::string(name) + (spare ? "_spare" : "");
}
std::string collider_edges_alias(Place p, std::string_view name, bool written) {
    if (written) return variable_of(p.step.after_edges ? Field::lifted : Field::lifted_once);
    return name == "displacement" && p.step.after_edges ? variable_of(Field::lifted_once) : std::string();
}

using Variants = std::vector<VariantRow>;

// clang-format off: every kernel is a line.
/// Returns the rows by StepKind up to springs one by one, then those up to contact between cloths: label, kernels, push
/// constants, turn, aliases.
std::vector<StepRow> first_rows() {
    using enum Kernel;
    const Variants none, masked_only{{"masked", masked}}, cut{{"masked", masked}, {"buffered", buffered}},
        release{{"tension", releases_tension}, {"masked", releases_masked_tension}, {"second_order", second_order}},
        predict{{"wind", windy}, {"buffered", buffered}},
        force{{"wind", windy}, {"before", keeps_before}, {"buffered", buffered}},
        explicit_step{{"masked", masked}, {"wind", windy}, {"buffered", buffered}},
        order{{"second_order", second_order}}, all_twist{{"masked", masked}, {"second_order", second_order}},
        twist{{"masked", masked}, {"second_order", second_order}, {"buffered", buffered}},
        spring{{"masked", masked}, {"tension", stores_spring_tension}, {"buffered", buffered}};
    return {
        {StepKind::stiffness, "stiffness", {{plain, "stiffness.comp", none, over_particles}}, stiffness_push},
        {StepKind::release, "pin release", {{plain, "pin_release.comp", release, over_pins}}, release_push},
        {StepKind::wind, "wind", {{plain, "wind.comp", cut, over_wide_columns}}, wind_push},
        {StepKind::predict, "predict", {{plain, "predict.comp", predict, over_strips}}, nullptr, turns_if_asked},
        {StepKind::force, "force", {{plain, "force.comp", force, over_strips}}, nullptr, turns_if_asked},
        {StepKind::explicit_step,
         explicit_label,
         {{plain, "explicit.comp", explicit_step, over_particles},
          {explicit_stream, "explicit_stream.comp", masked_only, over_explicit_stream},
          {explicit_tile, "explicit_tile.comp", masked_only, over_tiles}},
         nullptr,
         turns_state},
        {StepKind::pin, "pin motion", {{plain, "pin_motion.comp", none, over_pins}}, pin_push},
        {StepKind::bend_targets, "bending at rest", {{plain, "bend_targets.comp", order, over_particles}}},
        {StepKind::bend_pulls, "pulls of bending", {{plain, "bend_pulls.comp", none, over_particles}}, grid_push},
        {StepKind::bend, bend_label, {{plain, "bend.comp", cut, over_bends}}},
        {StepKind::twist, twist_label, {{plain, "twist.comp", twist, over_twists}}},
        {StepKind::all_twist,
         "twist of all cells",
         {{twist_stream, "twist_stream.comp", all_twist, over_twist_stream},
          {twist_tile, "twist_tile.comp", all_twist, over_tiles}},
         nullptr,
         turns_displacement},
        {StepKind::spring,
         spring_label,
         {{plain, "spring.comp", spring, over_springs}},
         spring_push,
         nullptr,
         tension_alias<glsl::SpringPush>},
    };
}

std::vector<StepRow> other_rows() {
    using enum Kernel;
    const Variants none, stored{{"buffered", buffered}}, masked_only{{"masked", masked}},
        edges{{"masked", masked}, {"meshes", meets_meshes}, {"buffered", collides_buffered}},
        springs{{"masked", masked}, {"tension", stores_stretch_tension}, {"carried", carries_tension}},
        line{{"masked", masked}, {"bent", bends}, {"buffered", buffered}}, reduced{{"masked", masked}, {"bent", bends}},
        nested{{"masked", masked}, {"sheared", shears}, {"buffered", buffered}},
        collide{{"history", second_order},          {"led", after_edges},     {"supporting", supporting},
                {"after_impulses", after_impulses}, {"meshes", meets_meshes}, {"buffered", collides_buffered}},
        advance{{"home", comes_home},
                {"control_home", control_comes_home},
                {"excess", keeps_excess},
                {"buffered", buffered}};
    return {
        {StepKind::all_springs,
         "all springs",
         {{spring_stream, "spring_stream.comp", springs, over_spring_stream},
          {spring_tile, "spring_tile.comp", springs, over_tiles}},
         nullptr,
         turns_displacement,
         all_springs_alias},
        {StepKind::line,
         line_label,
         {{plain, "line.comp", line, over_lines},
          {line_parts, "line_parts.comp", masked_only, over_line_parts},
          {line_cyclic, "line_cyclic.comp", reduced, over_line_particles}},
         nullptr,
         nullptr,
         tension_alias<glsl::LinePush>},
        {StepKind::nested, "nested boxes", {{plain, "nested.comp", nested, over_nested_pins}}},
        {StepKind::tether, "tethers", {{plain, "tether.comp", stored, over_strips}}, grid_push},
        {StepKind::collider_edges,
         collider_edges_label,
         {{plain, "collider_edges.comp", edges, over_columns}},
         collider_edges_push,
         nullptr,
         collider_edges_alias},
        {StepKind::collide,
         "collision",
         {{plain, "collision.comp", collide, over_columns}},
         collision_push,
         nullptr,
         before_alias},
        {StepKind::residual, "residual", {{plain, "residual.comp", masked_only, over_residual_strips}}, residual_push},
        {StepKind::decide,
         "iteration decision",
         {{plain, "iteration_decision.comp", none, one_invocation}},
         decide_push},
        {StepKind::advance,
         "advance",
         {{plain, "advance.comp", advance, over_strips}},
         grid_push,
         turns_home,
         before_alias},
    };
}
// clang-format on

std::vector<StepRow> all_rows() {
    std::vector<StepRow> rows;
    for (const auto& some : {first_rows(), other_rows(), contact_step_rows()})
        rows.insert(rows.end(), some.begin(), some.end());
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (rows[k].kind != static_cast<StepKind>(k)) throw std::logic_error("rows of steps are not by StepKind");
    return rows;
}

}  // namespace

std::string before_alias(const StepPlace& place, std::string_view name, bool) {
    return name == "displacement_before" && scheme_of(place).spare_state ? variable_of(Field::displacement_spare)
                                                                         : std::string();
}

std::span<const StepRow> step_rows() {
    static const std::vector<StepRow> rows = all_rows();
    return rows;
}

}  // namespace drape
