#include <fmt/format.h>

#include <stdexcept>

#include "cloth/directions.h"
#include "cloth/kernel_steps.h"
#include "cloth/substep_change.h"
#include "solver/step_size.h"

namespace drape {

namespace {

using Place = const StepPlace&;

template <class Push>
std::size_t channel_of(Place p) {
    return static_cast<std::size_t>(p.step.push<Push>().channel);
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
std::string seam_words(Place p) {
    constexpr const char* words[] = {"predicted", "released", "solved", "touched", "forces", "normals",
                                     "begun",     "met",      "orders", "ripped",  "areas"};
    return words[p.step.push<glsl::SeamPush>().stage];
}
std::string seam_give_label(Place p) { return "seam gives " + seam_words(p); }
std::string seam_take_label(Place p) { return "seam takes " + seam_words(p); }
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
    return glsl::ReleasePush{p.scheme().release_stiffness,
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
graph::PushConstants advance_push(Place p) {
    const ClothModel& cloth = *p.cloth->model;
    return glsl::AdvancePush{cloth.grid.size(),
                             static_cast<float>(0.5 * excess_share(cloth.damping, cloth.substep_length)), 0};
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
std::string seam_alias(Place p, std::string_view name, bool written) {
    if (name == "wind_force" && p.step.push<glsl::SeamPush>().stage == glsl::seam_normals)
        return variable_of(Field::normal);
    return before_alias(p, name, written);
}
std::string collider_edges_alias(Place p, std::string_view name, bool written) {
    if (written) return variable_of(p.step.after_edges ? Field::lifted : Field::lifted_once);
    return name == "displacement" && p.step.after_edges ? variable_of(Field::lifted_once) : std::string();
}

// clang-format off: every kernel is a line.
/// Returns the rows by StepKind up to springs one by one, then those up to contact between cloths: label, kernels, push
/// constants, turn, aliases.
std::vector<StepRow> first_rows() {
    using enum Kernel;
    return {
        {StepKind::stiffness, "stiffness", {{plain, "stiffness.comp", over_particles}}, stiffness_push},
        {StepKind::release, "pin release", {{plain, "pin_release.comp", over_pins}}, release_push},
        {StepKind::gas_area, "gas areas", {{plain, "gas_area.comp", over_particles}}},
        {StepKind::gas_sum, "gas sums", {{plain, "gas_sum.comp", over_gas_sums}}},
        {StepKind::gas_pressure, "gas pressure", {{plain, "gas_pressure.comp", one_workgroup}}},
        {StepKind::wind, "wind", {{plain, "wind.comp", over_wide_columns}}, wind_push},
        {StepKind::predict, "predict", {{plain, "predict.comp", over_strips}}, nullptr, turns_if_asked},
        {StepKind::force, "force", {{plain, "force.comp", over_strips}}, nullptr, turns_if_asked},
        {StepKind::explicit_step,
         explicit_label,
         {{plain, "explicit.comp", over_particles},
          {explicit_stream, "explicit_stream.comp", over_explicit_stream},
          {explicit_tile, "explicit_tile.comp", over_tiles}},
         nullptr,
         turns_state},
        {StepKind::pin, "pin motion", {{plain, "pin_motion.comp", over_pins}}, pin_push},
        {StepKind::bend_targets, "bending at rest", {{plain, "bend_targets.comp", over_particles}}},
        {StepKind::bend_pulls, "pulls of bending", {{plain, "bend_pulls.comp", over_particles}}, grid_push},
        {StepKind::bend, bend_label, {{plain, "bend.comp", over_bends}}},
        {StepKind::twist, twist_label, {{plain, "twist.comp", over_twists}}},
        {StepKind::all_twist,
         "twist of all cells",
         {{twist_stream, "twist_stream.comp", over_twist_stream}, {twist_tile, "twist_tile.comp", over_tiles}},
         nullptr,
         turns_displacement},
        {StepKind::spring,
         spring_label,
         {{plain, "spring.comp", over_springs}},
         spring_push,
         nullptr,
         tension_alias<glsl::SpringPush>},
    };
}

std::vector<StepRow> other_rows() {
    using enum Kernel;
    return {
        {StepKind::all_springs,
         "all springs",
         {{spring_stream, "spring_stream.comp", over_spring_stream}, {spring_tile, "spring_tile.comp", over_tiles}},
         nullptr,
         turns_displacement,
         all_springs_alias},
        {StepKind::line,
         line_label,
         {{plain, "line.comp", over_lines},
          {line_parts, "line_parts.comp", over_line_parts},
          {line_cyclic, "line_cyclic.comp", over_line_particles}},
         nullptr,
         nullptr,
         tension_alias<glsl::LinePush>},
        {StepKind::nested, "nested boxes", {{plain, "nested.comp", over_nested_pins}}},
        {StepKind::torque, "torque", {{plain, "torque.comp", over_torque_sums}}},
        {StepKind::rotate, "rotation", {{plain, "rotate.comp", over_strips}}},
        {StepKind::tether, "tethers", {{plain, "tether.comp", over_strips}}, grid_push},
        {StepKind::seam_give,
         seam_give_label,
         {{plain, "seam_give.comp", over_sewn_particles}},
         nullptr,
         nullptr,
         seam_alias},
        {StepKind::seam_take,
         seam_take_label,
         {{plain, "seam_take.comp", over_sewn_particles}},
         nullptr,
         nullptr,
         seam_alias},
        {StepKind::collider_edges,
         collider_edges_label,
         {{plain, "collider_edges.comp", over_columns}},
         collider_edges_push,
         nullptr,
         collider_edges_alias},
        {StepKind::collide,
         "collision",
         {{plain, "collision.comp", over_columns}},
         collision_push,
         nullptr,
         before_alias},
        {StepKind::residual, "residual", {{plain, "residual.comp", over_residual_strips}}, residual_push},
        {StepKind::decide, "iteration decision", {{plain, "iteration_decision.comp", one_invocation}}, decide_push},
        {StepKind::advance, "advance", {{plain, "advance.comp", over_strips}}, advance_push, turns_home, before_alias},
        {StepKind::clear_impulses, "impulses", {{plain, "clear_impulses.comp", one_workgroup}}},
        {StepKind::body_meet, "contact of bodies", {{plain, "body_meet.comp", one_workgroup_of_bodies}}},
        {StepKind::body_move, "motion of bodies", {{plain, "body_move.comp", over_bodies}}},
        {StepKind::body_strike, "strikes on bodies", {{plain, "body_strike.comp", over_bodies}}},
        {StepKind::momentum, "momentum", {{plain, "momentum.comp", over_strips}}},
        {StepKind::worst_impulses, "worst impulses", {{plain, "worst_impulses.comp", one_workgroup}}},
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
    return name == "displacement_before" && place.scheme().spare_state ? variable_of(Field::displacement_spare)
                                                                       : std::string();
}

std::span<const StepRow> step_rows() {
    static const std::vector<StepRow> rows = all_rows();
    return rows;
}

}  // namespace drape
