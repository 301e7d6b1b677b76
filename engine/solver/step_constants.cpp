#include <algorithm>
#include <stdexcept>

#include "cloth/cyclic_lines.h"
#include "cloth/directions.h"
#include "cloth/forces.h"
#include "cloth/frame_inputs.h"
#include "cloth/kernel_steps.h"
#include "solver/step_size.h"

namespace drape {

namespace {

using Place = const StepPlace&;

std::uint32_t direction_bits(Place p) {
    std::uint32_t bits = 0;
    for (int d = 0; d < static_cast<int>(spring_directions.size()); ++d)
        if (has_direction(p.step.push<glsl::AllSpringsPush>(), d)) bits |= 1u << d;
    return bits;
}

glsl::ivec2 group_of_lines(Place p) { return cyclic_group(p.step.push<glsl::LinePush>().particle_count); }

std::uint32_t group_width(Place p) {
    if (p.step.kind == StepKind::nested) return nested_group(p);
    if (p.step.kernel == Kernel::line_parts)
        return parts_group(p.step.push<glsl::LinePush>().particle_count, p.step.subgroup);
    return static_cast<std::uint32_t>(group_of_lines(p).x);
}

bool has(Place p, Field field) { return (*p.cloth)[field].valid(); }
bool second_order(Place p) { return p.scheme().second_order; }
bool carries_tension(Place p) { return p.scheme().carries_tension[0]; }
/// Passes store to the state's images, or to the sheet's, through their buffer views.
bool buffered(Place p) { return p.cloth ? p.cloth->buffered : p.contact->buffered; }
bool stores_tension(Place p) {
    const auto& push = p.step.push<glsl::SpringPush>();
    const auto direction = static_cast<std::size_t>(push.channel);
    return has(p, tension_of(direction)) &&
           (p.scheme().carries_tension[direction] || (p.step.last && push.compliance > 0));
}
/// All springs of an iteration: only the stretch springs' tension is stored, for the stretch error.
bool stores_stretch_tension(Place p) {
    return !carries_tension(p) && p.step.last && has(p, Field::tension_row) &&
           p.step.push<glsl::AllSpringsPush>().compliance.x > 0;
}
/// The torque of a substep's pulls needs the displacement of the substep before.
bool keeps_before(Place p) { return (p.step.last || !p.scheme().ended.empty()) && has(p, Field::displacement_before); }
/// Returns whether some cloths started through each other.
bool crossed(Place p) { return p.step.push<glsl::SelfContactPush>().crossed_count > 0; }

int seam_stage(Place p) { return p.step.push<glsl::SeamPush>().stage; }
bool seam_moves_all(Place p) {
    return seam_stage(p) == glsl::seam_predicted || seam_stage(p) == glsl::seam_released ||
           seam_stage(p) == glsl::seam_begun || seam_stage(p) == glsl::seam_met;
}
bool seam_leads(Place p) {
    const bool steps = seam_stage(p) == glsl::seam_predicted && !p.model.method().iterates();
    return lies_between(p.cloth->model->sewn) && (steps || seam_stage(p) == glsl::seam_solved);
}
bool seam_has_vectors(Place p) {
    return seam_stage(p) == glsl::seam_forces || seam_stage(p) == glsl::seam_normals ||
           seam_stage(p) == glsl::seam_areas;
}
/// Returns the place that has the order of steps of all cloths that are sewn together, or -1.
int joint_of(Place p) {
    if (const auto* gas = std::get_if<glsl::GasPush>(&p.step.constants)) return gas->joint;
    return p.step.push<glsl::PredictPush>().joint;
}
/// Returns whether positions lack the last substep's displacement. At a frame's end they have it.
bool lags(Place p) { return p.step.substep > 0 && p.step.substep < p.model.scene.solver.substeps; }
bool has_seam_loads(Place p) { return has(p, Field::seam_loads); }
/// Returns whether what moves particles pulls at seams: springs, air, or by methods that do not iterate whole steps.
bool seam_pulls(Place p) {
    const int stage = seam_stage(p);
    return has_seam_loads(p) && (stage == glsl::seam_solved || stage == glsl::seam_forces ||
                                 (stage == glsl::seam_predicted && !p.model.method().iterates()));
}
/// Contact writes the position and the displacement of the substep before.
std::uint32_t sews_touched(Place p) {
    const bool moves = seam_stage(p) == glsl::seam_predicted || seam_stage(p) == glsl::seam_touched;
    return seam_stage(p) == glsl::seam_met || (moves && !p.model.scene.colliders.empty()) ? 1u : 0u;
}

/// Returns the directions of springs whose tension is known when a frame begins and ends: explicit steps keep none.
std::uint32_t known_tensions(Place p) {
    std::uint32_t bits = 0;
    for (std::size_t d = 0; d < spring_directions.size(); ++d)
        if (!p.scheme().spare_state && has(p, tension_of(d))) bits |= 1u << d;
    return bits;
}

struct ConstantRow {
    std::string_view name;
    std::uint32_t (*value)(Place);
};

// clang-format off: every constant is a line.
constexpr ConstantRow constant_rows[] = {
    {"acted", [](Place p) { return p.model.options.bodies ? 1u : 0u; }},
    {"advance", [](Place p) { return p.step.substep > 0 ? 1u : 0u; }},
    {"after_edges", [](Place p) { return p.step.after_edges ? 1u : 0u; }},
    {"after_impulses", [](Place p) { return p.step.after_impulses ? 1u : 0u; }},
    {"again", [](Place p) { return p.step.after_edges ? 1u : 0u; }},
    {"bends", [](Place p) { return p.step.push<glsl::LinePush>().bend > 0 ? 1u : 0u; }},
    {"books", [](Place p) { return sums_impulses(p.model.scene) ? 1u : 0u; }},
    {"boxes_meet", [](Place p) { return boxes_meet(p.model) ? 1u : 0u; }},
    {"buffered", [](Place p) { return buffered(p) ? 1u : 0u; }},
    {"carries_tension", [](Place p) { return carries_tension(p) ? 1u : 0u; }},
    {"carries_to_release", [](Place p) { return p.scheme().release_stiffness.x > 0 ? 1u : 0u; }},
    {"cloth_count", [](Place p) { return static_cast<std::uint32_t>(p.model.cloths.size()); }},
    {"comes_home", [](Place p) { return p.cloth->away ? 1u : 0u; }},
    {"control_comes_home", [](Place p) { return second_order(p) && p.step.substep % 2 == 1 ? 1u : 0u; }},
    {"crossed", [](Place p) { return crossed(p) ? 1u : 0u; }},
    {"directions", direction_bits},
    {"encloses", [](Place p) { return has(p, Field::gas) ? 1u : 0u; }},
    {"ends_frame", [](Place p) { return p.step.last ? 1u : 0u; }},
    {"entries_each", [](Place p) { return p.device.entries_each(); }},
    {"first_pin_row", [](Place p) { return first_pin_row(p.model.scene); }},
    {"first_iteration", [](Place p) { return p.step.iteration == 0 ? 1u : 0u; }},
    {"halo", [](Place p) { return tile_of(p.step.kind, p.cloth->model->grid).halo; }},
    {"has_bend", [](Place p) { return p.step.push<glsl::ExplicitPush>().twist > 0 ? 1u : 0u; }},
    {"has_light", [](Place p) { return has_light_bodies(p.model) ? 1u : 0u; }},
    {"has_shear", [](Place p) { return p.step.push<glsl::ExplicitPush>().relative_stiffness.z > 0 ? 1u : 0u; }},
    {"has_skin", [](Place p) { return (*p.cloth)[Field::skin].valid() ? 1u : 0u; }},
    {"has_skins", [](Place p) { return (*p.contact)[ContactField::skins].valid() ? 1u : 0u; }},
    {"impulse_rows", [](Place p) { return impulse_row_count(p.model.scene); }},
    {"keeps_before", [](Place p) { return keeps_before(p) ? 1u : 0u; }},
    {"keeps_contact", [](Place p) { return has(p, Field::contact_impulses) ? 1u : 0u; }},
    {"keeps_excess", [](Place p) { return has(p, Field::end_excess) ? 1u : 0u; }},
    {"lags", [](Place p) { return lags(p) ? 1u : 0u; }},
    {"load_depth", [](Place p) { return p.cloth->model->load_depth; }},
    {"local_size_x", group_width},
    {"local_size_y", [](Place p) { return static_cast<std::uint32_t>(group_of_lines(p).y); }},
    {"looks_back", [](Place p) { return p.step.looks_back ? 1u : 0u; }},
    {"masked", [](Place p) { return p.cloth->masked() ? 1u : 0u; }},
    {"meets", [](Place p) { return bodies_meet(p.model) ? 1u : 0u; }},
    {"member_count", [](Place p) { return static_cast<std::uint32_t>(p.model.member_count); }},
    {"obstacles_move", [](Place p) { return obstacles_move(p.model) ? 1u : 0u; }},
    {"own_rest", [](Place p) { return p.cloth->own_rest(); }},
    {"pays_ahead", [](Place p) { return p.step.last && p.step.substep > 0 && has(p, Field::paid) ? 1u : 0u; }},
    {"pointed", [](Place p) { return !p.model.bodies.front().hull_points.empty() ? 1u : 0u; }},
    {"second_order", [](Place p) { return second_order(p) ? 1u : 0u; }},
    {"sewn", [](Place p) { return p.model.self_contact->is_sewn() ? 1u : 0u; }},
    {"sewn_to_others", [](Place p) { return joint_of(p) >= 0 ? 1u : 0u; }},
    {"sews_between", [](Place p) { return lies_between(p.cloth->model->sewn) ? 1u : 0u; }},
    {"sews_closing", [](Place p) { return p.model.closings.empty() ? 0u : 1u; }},
    {"sews_ends", [](Place p) { return seam_stage(p) == glsl::seam_ripped ? 1u : 0u; }},
    {"sews_leads", [](Place p) { return seam_leads(p) ? 1u : 0u; }},
    {"sews_orders", [](Place p) { return seam_stage(p) == glsl::seam_orders ? 1u : 0u; }},
    {"sews_predicted", [](Place p) { return seam_moves_all(p) ? 1u : 0u; }},
    {"sews_pulls", [](Place p) { return seam_pulls(p) ? 1u : 0u; }},
    {"sews_rips", [](Place p) { return has_seam_loads(p) ? 1u : 0u; }},
    {"sews_touched", sews_touched},
    {"sews_vectors", [](Place p) { return seam_has_vectors(p) ? 1u : 0u; }},
    {"sews_weight", [](Place p) { return p.model.weighs && seam_stage(p) == glsl::seam_forces ? 1u : 0u; }},
    {"sheared", [](Place p) { return p.step.push<glsl::NestedPush>().rest_length.z > 0 ? 1u : 0u; }},
    {"splits", [](Place p) { return splits_pins(p.model) ? 1u : 0u; }},
    {"steps", [](Place p) { return p.step.count; }},
    {"stores_stretch_tension", [](Place p) { return stores_stretch_tension(p) ? 1u : 0u; }},
    {"stores_tension", [](Place p) { return stores_tension(p) ? 1u : 0u; }},
    {"strip_columns", [](Place p) { return p.device.strip_columns(); }},
    {"strip_length", [](Place p) { return p.device.strip_length(); }},
    {"strip_rows", [](Place p) { return p.device.strip_rows(step_rounds(p)); }},
    {vulkan::subgroup_constant, [](Place p) { return p.step.subgroup; }},
    {"supported", [](Place p) { return p.model.scene.colliders.empty() ? 0u : 1u; }},
    {"supporting", [](Place p) { return p.step.supporting || p.step.after_impulses ? 1u : 0u; }},
    {"tensions", known_tensions},
    {"turns", [](Place p) { return p.step.turns ? 1u : 0u; }},
    {"weather_vectors", [](Place p) { return static_cast<std::uint32_t>(weather_vectors(p.model)); }},
    {"weighs", [](Place p) { return p.model.weighs ? 1u : 0u; }},
    {"wide", [](Place p) { return p.device.wide_atomics() ? 1u : 0u; }},
    {"windy", [](Place p) { return has(p, Field::wind_force) ? 1u : 0u; }},
};
// clang-format on

}  // namespace

std::optional<std::uint32_t> scene_constant(const SimulationModel& model, std::string_view name) {
    if (name == "leaves_out") return model.options.skip ? 1u : 0u;
    if (name == "round_count") return model.collision_rounds();
    const auto ends = kind_ends(model.scene.colliders);
    for (std::size_t kind = 0; kind < ends.size(); ++kind)
        if (name == std::string(collider_lists[kind]) + "_end") return ends[kind];
    return std::nullopt;
}

std::uint32_t step_constant(const StepPlace& place, std::string_view name) {
    const auto row = std::ranges::find(constant_rows, name, &ConstantRow::name);
    if (row != std::end(constant_rows)) return row->value(place);
    if (const auto value = scene_constant(place.model, name)) return *value;
    throw std::logic_error("nobody gives constant '" + std::string(name) + "' a value");
}

}  // namespace drape
