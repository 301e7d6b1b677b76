#include "cloth/cloth_state.h"

#include <algorithm>
#include <array>
#include <bit>

#include "cloth/air.h"
#include "cloth/cloth_statistics.h"
#include "cloth/forces.h"
#include "shared/bend_types.h"
#include "shared/body_types.h"
#include "shared/cut_types.h"
#include "shared/line_types.h"
#include "shared/residual_types.h"
#include "shared/rotation_types.h"

namespace drape {

namespace {

using glsl::layout_of;
using Context = const FieldContext&;
using Bytes = std::vector<std::byte>;

bool always(Context) { return true; }
bool sums_impulses(Context c) { return drape::sums_impulses(c.model.scene); }
bool splits_pins(Context c) { return drape::splits_pins(c.model); }
std::size_t index_of(Context c) { return static_cast<std::size_t>(&c.cloth - c.model.cloths.data()); }
bool keeps_contact(Context c) {
    return c.model.scene.force_fields && (!c.model.scene.colliders.empty() || c.model.self_contact);
}
bool bears_bodies(Context c) { return has_bodies(c.model, index_of(c)); }
bool meets_bodies(Context c) { return bears_bodies(c) && bodies_meet(c.model); }
bool has_hulls(Context c) { return bears_bodies(c) && !c.model.bodies[c.cloth.member].hull_points.empty(); }
bool strikes_bodies(Context c) { return body_count(c.model) > 0; }
bool drawn(Context c) { return c.needs.drawing; }
bool masked(Context c) { return c.topology.masked(); }
bool windy(Context c) { return c.model.windy; }
bool loaded(Context c) { return c.cloth.load_depth > 0; }
bool encloses(Context c) { return c.cloth.gas.has_value(); }
bool windy_and_masked(Context c) { return windy(c) && masked(c); }
bool stiffens(Context c) { return c.cloth.stiffens; }
bool rests_bent(Context c) { return c.cloth.rests_bent(); }
bool adaptive(Context c) { return c.model.adaptive(); }
bool gathers(Context c) { return c.cloth.scheme.spare_state; }
bool turns(Context c) { return gathers(c) || c.cloth.scheme.spare_displacement; }
bool second_order(Context c) { return c.cloth.scheme.second_order; }
bool line_solved(Context c) { return c.cloth.scheme.line_scratch; }
bool judged(Context c) { return c.needs.statistics || c.model.compares_states(); }
/// Contact ends every frame with its velocity, which spares its passes a form without.
bool keeps_excess(Context c) { return judged(c) || c.model.self_contact || c.model.scene.forces; }
bool rotates(Context c) { return !c.cloth.scheme.ended.empty(); }
bool keeps_before(Context c) {
    return second_order(c) || rotates(c) || ((keeps_excess(c) || !c.model.scene.colliders.empty()) && !gathers(c));
}
bool turns_in_contact(Context c) { return c.model.self_contact && c.cloth.turn; }
bool sums_torques(Context c) { return rotates(c) || turns_in_contact(c); }
bool nested(Context c) { return !c.cloth.scheme.nested_table.empty(); }
bool tethered(Context c) { return !c.cloth.tethers.empty(); }
bool has_own_skin(Context c) { return !c.cloth.skin.empty() && !c.model.scene.colliders.empty(); }
bool pinned(Context c) { return !c.cloth.pinned.empty(); }
template <std::size_t direction>
bool tense(Context c) {
    const bool stretch_error =
        direction < stretch_direction_count &&
        (judged(c) || c.model.adaptive() || ((splits_pins(c) || c.model.scene.force_fields) && !gathers(c)));
    return c.cloth.scheme.carries_tension[direction] || stretch_error;
}
bool spares_tension(Context c) { return c.cloth.scheme.spare_tension; }

FieldExtent particles(Context c) { return {c.cloth.grid.columns(), c.cloth.grid.rows()}; }
FieldExtent all_particles(Context c) { return {c.cloth.grid.particle_count()}; }
FieldExtent spring_list(Context c) {
    return {c.cloth.grid.columns() * (c.cloth.rest_scales.empty() ? 1u : 2u), c.cloth.grid.rows()};
}
FieldExtent load_list(Context c) { return {c.cloth.load_depth * c.cloth.grid.columns(), c.cloth.grid.rows()}; }
FieldExtent target_list(Context c) { return {glsl::bend_parts * c.cloth.grid.columns(), c.cloth.grid.rows()}; }
FieldExtent line_scratch(Context c) { return line_scratch_extent(c.cloth.grid); }
FieldExtent control_texels(Context) { return {glsl::control_texel_count}; }
FieldExtent impulse_table(Context c) { return {glsl::impulse_columns, impulse_row_count(c.model.scene)}; }
FieldExtent body_list(Context c) { return {body_count(c.model) + obstacle_count(c.model)}; }
FieldExtent pair_list(Context c) {
    const std::size_t bodies = body_count(c.model);
    return {glsl::pair_meetings * bodies * (bodies + obstacle_count(c.model))};
}
FieldExtent hull_list(Context c) { return {c.model.bodies[c.cloth.member].hull_points.size()}; }
FieldExtent body_table(Context c) { return {glsl::body_texels, body_count(c.model)}; }
FieldExtent torque_list(Context c) { return {glsl::torque_texels, torque_count(c.cloth.grid)}; }
FieldExtent nested_list(Context c) { return {c.cloth.scheme.nested_table.size()}; }
FieldExtent tether_list(Context c) { return {c.cloth.tethers.size()}; }
FieldExtent particle_list(Context c) { return {c.cloth.skin.size()}; }
FieldExtent one(Context) { return {1}; }
FieldExtent pinned_list(Context c) { return {c.cloth.pinned.size()}; }
FieldExtent cells(Context c) { return {c.cloth.grid.columns() - 1, c.cloth.grid.rows() - 1}; }

FieldExtent residual_list(Context c) { return {residual_count(c.cloth.grid)}; }
FieldExtent size_list(Context) { return {glsl::iteration_size_count}; }
FieldExtent iteration_list(Context) { return {glsl::iteration_size_count + 1}; }

std::vector<std::byte> start_excess(Context c) { return bytes_of_list(c.cloth.start_excess()); }
std::vector<std::byte> share_of_mass(Context c) { return bytes_of_list(mass_shares(c.cloth)); }
bool meets_on_colliders(Context c) { return c.model.self_contact && !c.model.scene.colliders.empty(); }
bool cut_by_edges(Context c) { return c.cloth.edge_reach > 0; }
std::vector<std::byte> cell_bits(Context c) { return bytes_of_list(c.topology.grid().cells()); }
std::vector<std::byte> reference(Context c) { return bytes_of_list(std::vector{statistics_reference(c.cloth)}); }

std::vector<std::byte> sewn_list(Context c) {
    std::vector<glsl::SewnParticle> list;
    for (const Sewn& each : c.cloth.sewn) list.push_back(each.sewn);
    return bytes_of_list(list);
}
std::size_t draw_list_room(Context c, std::size_t count) {
    return c.model.scene.comes_apart() ? draw_list_capacity(count) : count;
}

/// Shaders see these fields as images and, where they are `buffered`, as buffers.
constexpr FieldView stored = FieldView::image_and_buffer;

/// Returns the rows of the table up to loads and gas.
std::vector<FieldRow> motion_rows() {
    using enum FieldLife;
    using enum FieldView;
    static const auto &vector = layout_of<glsl::vec4>(), &integer = layout_of<glsl::uint>();
    return {
        {Field::position, "position", stored, vector, state, always, particles,
         [](Context c) { return bytes_of_list(c.cloth.position); }},
        {Field::displacement, "displacement", stored, vector, state, always, particles,
         [](Context c) { return bytes_of_list(c.cloth.start_displacement()); }},
        {Field::position_remainder, "position remainder", stored, vector, state, always, particles},
        {Field::displacement_remainder, "displacement remainder", stored, vector, state, always, particles},
        {Field::position_spare, "position spare", stored, vector, frame, gathers, particles},
        {Field::displacement_spare, "displacement spare", stored, vector, frame, turns, particles},
        {Field::position_remainder_spare, "position remainder spare", stored, vector, frame, gathers, particles},
        {Field::displacement_remainder_spare, "displacement remainder spare", stored, vector, frame, gathers,
         particles},
        // The scratch belongs to the device, not to the frame: an invocation reads only what it wrote itself, and
        // nothing outlives a pass.
        {Field::line_scratch, "line scratch", stored, vector, device, line_solved, line_scratch},
        {Field::nested_rows, "nested rows", stored, vector, device, nested, particles},
        {Field::nested_boxes, "nested boxes", buffer, layout_of<glsl::ivec4>(), constant, nested, nested_list,
         [](Context c) { return bytes_of_list(c.cloth.scheme.nested_table); }},
        {Field::displacement_before, "displacement before", stored, vector, state, keeps_before, particles},
        {Field::velocity_excess, "velocity excess", stored, vector, state, second_order, particles},
        {Field::end_excess, "end excess", stored, vector, state, keeps_excess, particles, start_excess},
        {Field::statistics_reference, "statistics reference", image, vector, constant, judged, one, reference},
        {Field::line_control, "line control", image, integer, state, second_order, control_texels},
        {Field::line_control_spare, "line control spare", image, integer, frame, second_order, control_texels},
        {Field::torques, "torques", image, vector, frame, sums_torques, torque_list},
        {Field::paid, "paid", image, vector, frame, turns_in_contact,
         [](Context) { return FieldExtent{glsl::paid_texels}; }},
        {Field::angular_error, "angular error", image, vector, state, rotates, one},
        {Field::wind_force, "wind force", stored, vector, frame, windy, particles},
        {Field::loads, "loads", image, vector, constant, loaded, load_list,
         [](Context c) { return bytes_of_list(c.cloth.loads); }},
        {Field::gas, "gas", image, vector, state, encloses, [](Context) { return FieldExtent{glsl::gas_texels}; },
         [](Context c) {
             return bytes_of_list(std::vector{c.cloth.gas->start.now, c.cloth.gas->start.kept});
         }},
        {Field::gas_shares, "gas shares", buffer, layout_of<glsl::vec2>(), constant, encloses, all_particles,
         // Images of what cuts change are compared whether a cloth has them or not (cut_images).
         [](Context c) { return c.cloth.gas ? bytes_of_list(c.cloth.gas->shares) : std::vector<std::byte>(); }},
    };
}

/// Returns the rows of forces, bodies and contact, up to the bending at rest.
std::vector<FieldRow> contact_rows() {
    using enum FieldLife;
    using enum FieldView;
    static const auto &vector = layout_of<glsl::vec4>(), &integer = layout_of<glsl::uint>();
    return {
        {Field::impulses, "impulses", image, integer, state, sums_impulses, impulse_table},
        {Field::contact_impulses, "contact impulses", image, vector, state, keeps_contact, particles},
        {Field::bodies, "bodies", image, vector, state, bears_bodies, body_table,
         [](Context c) { return bytes_of_list(bodies_at_start(c.model, c.cloth.member)); }},
        {Field::body_constants, "body constants", buffer, layout_of<glsl::BodyConstants>(), constant, bears_bodies,
         body_list, [](Context c) { return bytes_of_list(body_constants(c.model, c.cloth.member)); }},
        {Field::struck, "struck", image, integer, state, strikes_bodies,
         [](Context c) {
             return FieldExtent{glsl::impulse_columns, body_count(c.model)};
         }},
        {Field::body_meetings, "body meetings", buffer, layout_of<glsl::BodyMeeting>(), device, meets_bodies,
         pair_list},
        {Field::met_bodies, "met bodies", buffer, layout_of<glsl::MetBody>(), device, meets_bodies, body_list},
        {Field::hull_points, "hull points", buffer, vector, constant, has_hulls, hull_list,
         [](Context c) { return bytes_of_list(c.model.bodies[c.cloth.member].hull_points); }},
        {Field::pin_numbers, "pin numbers", image, integer, constant, splits_pins, particles,
         [](Context c) { return bytes_of_list(pin_numbers(c.model, index_of(c))); }},
        {Field::lifted_once, "lifted once", stored, vector, frame, cut_by_edges, particles},
        {Field::lifted, "lifted", stored, vector, frame, cut_by_edges, particles},
        {Field::support, "support", image, vector, state, meets_on_colliders, particles},
        {Field::support_grip, "support grip", image, vector, state, meets_on_colliders, particles},
        {Field::normal, "normal", image, vector, frame, drawn, particles},
        {Field::whole_spring_share, "whole spring shares", image, vector, constant, stiffens, particles,
         [](Context c) { return bytes_of_list(c.topology.whole_spring_shares()); }},
        {Field::spring_share, "spring shares", image, vector, constant, masked, spring_list,
         [](Context c) { return bytes_of_list(spring_texels(c.topology)); }, stiffens},
        {Field::rest_shape, "rest shape", image, vector, constant, rests_bent, particles,
         [](Context c) { return bytes_of_list(c.cloth.rest_shape()); }},
        {Field::bend_targets, "bend targets", image, vector, frame, rests_bent, target_list},
    };
}

/// Returns the rows of the table from the masses on.
std::vector<FieldRow> other_rows() {
    using enum FieldLife;
    using enum FieldView;
    static const auto &vector = layout_of<glsl::vec4>(), &scalar = layout_of<float>(),
                      &integer = layout_of<glsl::uint>(), &sizes = layout_of<glsl::uvec4>();
    return {
        {Field::mass_share, "mass share", image, scalar, constant, masked, particles, share_of_mass},
        {Field::cells, "cells", image, integer, constant, masked, cells, cell_bits},
        {Field::air, "air", image, integer, constant, windy_and_masked, particles,
         [](Context c) { return bytes_of_list(air_bits(c.topology)); }},
        {Field::tear_limits, "tear limits", image, vector, constant,
         [](Context c) { return !c.cloth.tear_limits.empty(); }, particles,
         [](Context c) { return bytes_of_list(c.cloth.tear_limits); }},
        {Field::tension_row, "tension row", stored, scalar, state, tense<0>, particles},
        {Field::tension_column, "tension column", stored, scalar, state, tense<1>, particles},
        {Field::tension_shear_down_right, "tension shear down-right", stored, scalar, state, tense<2>, particles},
        {Field::tension_shear_down_left, "tension shear down-left", stored, scalar, state, tense<3>, particles},
        {Field::tension_row_spare, "tension row spare", stored, scalar, frame, spares_tension, particles},
        {Field::tension_column_spare, "tension column spare", stored, scalar, frame, spares_tension, particles},
        {Field::tension_shear_down_right_spare, "tension shear down-right spare", stored, scalar, frame, spares_tension,
         particles},
        {Field::tension_shear_down_left_spare, "tension shear down-left spare", stored, scalar, frame, spares_tension,
         particles},
        {Field::residuals, "residuals", buffer, layout_of<glsl::ResidualRecord>(), frame, adaptive, residual_list},
        {Field::iterations, "iterations", buffer, sizes, device, adaptive, iteration_list},
        // These sizes have no initial value, since the solver knows them only after it has added the passes.
        {Field::iteration_sizes, "iteration sizes", buffer, sizes, constant, adaptive, size_list},
        {Field::triangles, "triangles", buffer, integer, constant, drawn,
         [](Context c) { return FieldExtent{draw_list_room(c, c.topology.indices().size())}; },
         [](Context c) { return bytes_of_list(c.topology.indices()); }},
        {Field::cut_vertices, "cut vertices", buffer, layout_of<glsl::CutVertex>(), constant,
         [](Context c) { return c.needs.drawing && !c.topology.vertices().empty(); },
         [](Context c) { return FieldExtent{draw_list_capacity(c.topology.vertices().size())}; },
         [](Context c) { return bytes_of_list(c.topology.vertices()); }},
        {Field::tethers, "tethers", texel_buffer, layout_of<glsl::ParticleTethers>(), constant, tethered, tether_list,
         [](Context c) { return bytes_of_list(c.topology.tethers()); }},
        {Field::skin, "skin", buffer, layout_of<glsl::vec2>(), constant, has_own_skin, particle_list,
         [](Context c) { return bytes_of_list(c.cloth.skin); }},
        {Field::pinned_particles, "pinned particles", buffer, layout_of<glsl::PinnedParticle>(), constant, pinned,
         pinned_list, [](Context c) { return bytes_of_list(c.cloth.pinned); }},
        {Field::pin_motions, "pin motions", buffer, layout_of<glsl::PinMotion>(), input, pinned,
         [](Context c) { return FieldExtent{c.cloth.dynamic_pins.size() * c.model.most_substeps()}; }},
        {Field::sewn_particles, "sewn particles", buffer, layout_of<glsl::SewnParticle>(), constant,
         [](Context c) { return !c.cloth.sewn.empty(); }, [](Context c) { return FieldExtent{c.cloth.sewn.size()}; },
         sewn_list},
        {Field::sewn_leads, "sewn leads", buffer, layout_of<glsl::vec4>(), frame,
         [](Context c) { return lies_between(c.cloth.sewn); },
         [](Context c) { return FieldExtent{c.cloth.sewn.size()}; }},
        {Field::seam_loads, "seam loads", image, vector, state, [](Context c) { return rips(c.cloth.sewn); },
         particles},
    };
}

}  // namespace

std::span<const FieldRow> cloth_fields() {
    static const std::vector<FieldRow> table = [] {
        std::vector<FieldRow> all = motion_rows();
        for (const std::vector<FieldRow>& more : {contact_rows(), other_rows()})
            for (const FieldRow& row : more) all.push_back(row);
        return all;
    }();
    return table;
}

std::optional<Field> field_called(std::string_view variable) {
    static const auto fields = fields_by_variable(cloth_fields());
    return found_in(fields, variable);
}

Field tension_of(std::size_t direction) {
    static_assert(spring_directions.size() == 4);
    return static_cast<Field>(static_cast<std::size_t>(Field::tension_row) + direction);
}

Field tension_spare_of(std::size_t direction) {
    return static_cast<Field>(static_cast<std::size_t>(Field::tension_row_spare) + direction);
}

std::size_t draw_list_capacity(std::size_t count) { return std::bit_ceil(std::max<std::size_t>(count, 64)); }

FieldExtent line_scratch_extent(const Grid& grid) {
    constexpr std::uint64_t group = glsl::line_group_width, width = glsl::line_scratch_width;
    const std::uint64_t columns = grid.columns(), rows = grid.rows();
    const auto in_groups = [](std::uint64_t lines) { return (lines + group - 1) / group * group; };
    const std::uint64_t places = std::max(in_groups(rows) * columns, in_groups(columns) * rows);
    return {width, (2 * places + width - 1) / width};
}

std::uint32_t torque_count(const Grid& grid) {
    return static_cast<std::uint32_t>((grid.particle_count() - 1) / glsl::torque_particles + 1);
}

std::uint32_t residual_strip_count(const Grid& grid) {
    constexpr auto rows_per_strip = static_cast<std::uint32_t>(glsl::residual_rows);
    return (grid.rows() + rows_per_strip - 1) / rows_per_strip;
}

std::uint32_t residual_count(const Grid& grid) {
    constexpr auto width = static_cast<std::uint32_t>(glsl::workgroup_width);
    return (grid.columns() + width - 1) / width * residual_strip_count(grid);
}

}  // namespace drape
