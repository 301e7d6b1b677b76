#include "twin/twin.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "cloth/air.h"
#include "cloth/difference.h"
#include "cloth/kernel_steps.h"
#include "cloth/substep_change.h"
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/triangles_around.h"
#include "twin/twin_impulses.h"

namespace drape {

using namespace glsl;

TwinCloth::TwinCloth(const SimulationModel& model, std::size_t cloth) : topology(model.cloths[cloth]) {
    const FieldContext about{model, model.cloths[cloth], topology, {.drawing = true, .statistics = true}};
    const auto fill = [&](auto& values, const FieldRow& row) {
        values.resize(row.extent(about).count());
        if (!row.start) return;
        const std::vector<std::byte> bytes = row.start(about);
        std::memcpy(values.data(), bytes.data(), bytes.size());
    };
    for (const FieldRow& row : cloth_fields()) {
        const bool computed = row.life != FieldLife::constant && row.life != FieldLife::input;
        if (!row.is_image() || !computed || !row.needed(about)) continue;
        const auto place = static_cast<std::size_t>(row.field);
        if (&row.element == &layout_of<vec4>())
            fill(vectors[place], row);
        else if (&row.element == &layout_of<float>())
            fill(scalars[place], row);
        else
            fill(integer_fields[place], row);
    }
}

vec4 TwinCloth::force_on(std::size_t particle) const {
    const std::vector<vec4>& wind = (*this)[Field::wind_force];
    return wind.empty() ? vec4{0, 0, 0, 0} : wind[particle];
}

void TwinCloth::step_displacement(std::size_t particle, vec3 displacement, vec3 increment, float loss) {
    std::vector<vec4>& remainder = (*this)[Field::displacement_remainder];
    vec4& moved = (*this)[Field::displacement][particle];
    const vec3 counted = dragged_increment(released_increment(increment, moved.w), loss);
    const CompensatedSum stepped = compensated_add(displacement, counted, xyz(remainder[particle]));
    moved = texel(stepped.value, loss);
    remainder[particle] = texel(stepped.remainder);
}

float TwinCloth::dragged_weight_of(std::size_t particle) const {
    return dragged_weight((*this)[Field::position][particle].w, (*this)[Field::displacement][particle].w);
}

void TwinCloth::move_to(std::size_t particle, vec3 displacement) {
    vec4& moved = (*this)[Field::displacement][particle];
    moved = texel(displacement, moved.w);
}

vec3 TwinCloth::bend_target(ivec2 owner, int part) const {
    const std::vector<vec4>& targets = (*this)[Field::bend_targets];
    const auto columns = static_cast<std::size_t>(topology.grid().columns());
    if (targets.empty()) return {0, 0, 0};
    return xyz(targets[(std::size_t{bend_parts} * static_cast<std::size_t>(owner.y) + static_cast<std::size_t>(part)) *
                           columns +
                       static_cast<std::size_t>(owner.x)]);
}

std::span<const std::byte> TwinCloth::bytes(Field field) const {
    const auto place = static_cast<std::size_t>(field);
    if (!vectors[place].empty()) return std::as_bytes(std::span(vectors[place]));
    if (!scalars[place].empty()) return std::as_bytes(std::span(scalars[place]));
    return std::as_bytes(std::span(integer_fields[place]));
}

Twin::Twin(const SimulationModel& model, const Kernels& kernels) : model_(&model) {
    for (const Kernel each : {Kernel::line_parts, Kernel::line_cyclic})  // the others leave the plain ones' bits
        if (kernels.has(each)) kernels_.add(each);
    kernels_.group = kernels.group;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) cloths_.emplace_back(model, cloth);
    const auto sewn = std::make_shared<std::vector<glsl::SewnPlace>>(model.sewn_count);
    for (TwinCloth& cloth : cloths_) cloth.sewn = sewn;
    const auto sums = std::make_shared<std::vector<glsl::GasSum>>(model.gas_sum_count);
    for (TwinCloth& cloth : cloths_) cloth.gas_sums = sums;
    if (model.self_contact) contact_.emplace(*model.self_contact);
}

std::vector<Step> Twin::steps() const { return kernel_steps(*model_, kernels_); }

void Twin::run_frame(std::uint32_t frame) {
    FrameInputs inputs = frame_inputs(*model_, frame);
    for (const Step& step : steps()) run_step(step, inputs);
}

void Twin::disturb() {
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        std::vector<vec4>& positions = cloths_[cloth][Field::position];
        const float amplitude = disturbance(model_->cloths[cloth]);
        const std::vector<vec4> before = positions;
        const ivec2 size = model_->cloths[cloth].grid.size();
        const auto at = [&](int x, int y) {
            return xyz(
                before[static_cast<std::size_t>(std::clamp(y, 0, size.y - 1) * size.x + std::clamp(x, 0, size.x - 1))]);
        };
        for (int i = 0; i < size.x * size.y; ++i) {
            vec4& own = positions[static_cast<std::size_t>(i)];
            const int x = i % size.x, y = i / size.x;
            const vec3 there = disturbed(xyz(own), own.w, at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1),
                                         static_cast<std::uint32_t>(i), amplitude);
            own = {there.x, there.y, there.z, own.w};
        }
    }
}

void Twin::change_substep(const SimulationModel& run) {
    const std::vector<SubstepChange> changes =
        substep_changes(run, model_->scene.solver.substeps, run.scene.solver.substeps);
    model_ = &run;
    if (contact_) contact_->model = &*run.self_contact;
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        TwinCloth& state = cloths_[cloth];
        for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
            const ChangedSubstep changed =
                changed_substep(xyz(state[Field::displacement][i]), xyz(state[Field::end_excess][i]), changes[cloth]);
            state[Field::displacement][i] = texel(changed.displacement);
            state[Field::displacement_remainder][i] = {};
            state[Field::end_excess][i] = texel(changed.excess);
            if (state[Field::velocity_excess].empty()) continue;
            state[Field::displacement_before][i] = texel(changed.before);
            state[Field::velocity_excess][i] = texel(changed.excess_before);
        }
    }
}

namespace {

void run_stiffness(const TwinPlace& where) {
    where.state.topology.set_stiffness(where.inputs.stiffness[where.step.cloth]);
}

void run_wind(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const std::size_t own = step.substep * weather_vectors(scene);
    const vec3 velocity = xyz(inputs.wind[own]);
    const bool advance = step.substep > 0;
    const WindPush& push = model.wind;
    const std::size_t first_load = own + (scene.weighs ? 2 : 1) + static_cast<std::size_t>(push.first_load);
    TwinImpulses impulses(state);
    const auto now = [&](std::size_t index) {
        const vec3 start = xyz(state[Field::position][index]);
        return advance ? start + xyz(state[Field::displacement][index]) : start;
    };
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const std::size_t particle = at(model.grid, {x, y});
            const vec3 here = now(particle);
            const auto edge_to = [&](int i, int j) {
                return now(at(model.grid, {std::clamp(i, 0, push.grid.x - 1), std::clamp(j, 0, push.grid.y - 1)})) -
                       here;
            };
            AirEdges edges{edge_to(x - 1, y), edge_to(x + 1, y), edge_to(x, y - 1), edge_to(x, y + 1)};
            const vec3 relative = relative_wind(velocity, xyz(state[Field::displacement][particle]), push.inverse_step);
            uint air = border_air({x, y}, push.grid);
            const AirEdges all_edges = edges;
            if (state.topology.masked()) {
                air = air_of(state.topology, x, y);
                edges = own_edges(edges, air, relative, push.spacing);
            }
            WindForce sum = particle_wind_force(edges, air, relative, push.inverse_step, push.drag_coefficient,
                                                push.lift_coefficient, push.spacing);
            if (impulses.are_wanted())
                impulses.add(impulse_air, 0, sum.force,
                             units_per_newton(impulses.units(), push.inverse_step, push.inner_mass));
            if (model.load_depth > 0 || model.gas) {
                vec3 loaded = empty_sum();
                const vec3 area = area_vector(all_edges, air);
                for (std::size_t k = particle * model.load_depth; k < (particle + 1) * model.load_depth; ++k) {
                    const vec4 share = model.loads[k];
                    if (share.x < 0) break;
                    loaded = add_load(loaded, inputs.wind[first_load + static_cast<std::size_t>(share.x)], share, area);
                }
                if (model.gas) {
                    const GasEdges around{all_edges.left,        all_edges.right,       all_edges.up,
                                          all_edges.down,        edge_to(x - 1, y - 1), edge_to(x + 1, y - 1),
                                          edge_to(x - 1, y + 1), edge_to(x + 1, y + 1)};
                    loaded = gas_force(loaded, gas_area(around, air), state[Field::gas][0].x, push.gas_sign);
                }
                if (impulses.are_wanted())
                    impulses.add(impulse_loads, 0, loaded,
                                 units_per_newton(impulses.units(), push.inverse_step, push.inner_mass));
                sum.force = with_loads(sum.force, loaded, state[Field::position][particle].w);
            }
            if (scene.weighs)
                sum.force = add_weight(sum.force, xyz(inputs.wind[own + 1]), push.inner_mass,
                                       state[Field::position][particle].w);
            state[Field::wind_force][particle] = texel(sum.force, sum.drag);
        }
}

void run_force(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<ForcePush>();
    const bool advance = step.substep > 0;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const vec4 position = state[Field::position][i];
        const vec3 displacement = xyz(state[Field::displacement][i]);
        if (advance) {
            const CompensatedSum advanced =
                compensated_add(xyz(position), displacement, xyz(state[Field::position_remainder][i]));
            state[Field::position][i] = texel(advanced.value, position.w);
            state[Field::position_remainder][i] = texel(advanced.remainder);
        }
        if ((step.last || !model.scheme.ended.empty()) && !state[Field::displacement_before].empty())
            state[Field::displacement_before][i] = texel(displacement);
        if (position.w == 0.0f) continue;
        const vec4 applied = state.force_on(i);
        const vec3 increment = verlet_increment(displacement, xyz(push.gravity_step), xyz(applied), position.w,
                                                push.force_step, push.damping_loss);
        state.step_displacement(i, displacement, increment, drag_loss(applied.w, position.w, push.force_step));
    }
}

void run_pin(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const std::size_t first = step.substep * model.dynamic_pins.size();
    for (const PinnedParticle& pin : model.pinned) {
        const PinMotion& motion = motions[first + static_cast<std::size_t>(pin.index.z)];
        const ivec2 here{pin.index.x, pin.index.y};
        if (motion.held.x == 0.0f || !is_pinned(motion, here)) continue;
        const std::size_t i = at(model.grid, here);
        state[Field::displacement][i] = texel(pin_displacement(motion, xyz(pin.rest), xyz(state[Field::position][i])));
    }
}

void run_spring(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SpringPush>();
    std::vector<float>& tensions = state.tension(static_cast<std::size_t>(push.channel));
    const bool carried = step.iteration > 0 && model.scheme.carries_tension[push.channel];
    for (int py = 0; py < push.pair_count.y; ++py)
        for (int px = 0; px < push.pair_count.x; ++px) {
            const ivec2 owner = spring_owner({px, py}, push.offset, push.parity_axis, push.parity);
            const std::size_t first = at(model.grid, owner);
            const std::size_t second = at(model.grid, {owner.x + push.offset.x, owner.y + push.offset.y});
            const float share = state.topology.masked() ? component(state.topology.spring_shares()[first], push.channel)
                                                        : border_share(owner, push.offset, push.grid);
            const float tension = carried ? tensions[first] : 0.0f;
            const float weight_first = state.dragged_weight_of(first), weight_second = state.dragged_weight_of(second);
            const vec3 moved_first = xyz(state[Field::displacement][first]),
                       moved_second = xyz(state[Field::displacement][second]);
            const vec3 edge = spring_edge(xyz(state[Field::position][first]), xyz(state[Field::position][second]),
                                          moved_first, moved_second);
            const SpringResult result = project_spring(edge, weight_first + weight_second,
                                                       model.rest_length(push.rest_length, first, push.channel), share,
                                                       push.compression, push.compliance, tension);
            state.move_to(first, moved_by(moved_first, result.correction, -weight_first));
            state.move_to(second, moved_by(moved_second, result.correction, weight_second));
            if (!tensions.empty()) tensions[first] = result.tension;
        }
}

void run_tether(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const std::vector<ParticleTethers>& tethers = state.topology.tethers();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        if (state[Field::position][i].w == 0.0f) continue;
        vec3 moved = xyz(state[Field::displacement][i]);
        const auto apply = [&](int anchor, float length) {
            if (anchor < 0) return;
            const auto a = static_cast<std::size_t>(anchor);
            if (state[Field::position][a].w != 0.0f) return;
            const vec3 edge = spring_edge(xyz(state[Field::position][a]), xyz(state[Field::position][i]),
                                          xyz(state[Field::displacement][a]), moved);
            moved = moved_by(moved, tether_correction(edge, length), 1.0f);
        };
        apply(tethers[i].anchor_a, tethers[i].length_a);
        apply(tethers[i].anchor_b, tethers[i].length_b);
        state.move_to(i, moved);
    }
}

void run_advance(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const std::vector<vec4>& before = where.before();
    const auto half_share = static_cast<float>(0.5 * excess_share(where.model.damping, where.model.substep_length));
    for (std::size_t i = 0; i < state[Field::end_excess].size(); ++i)
        state[Field::end_excess][i] = texel(end_excess(xyz(state[Field::displacement][i]), xyz(before[i]), half_share));
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const CompensatedSum advanced =
            compensated_add(xyz(state[Field::position][i]), xyz(state[Field::displacement][i]),
                            xyz(state[Field::position_remainder][i]));
        state[Field::position][i] = texel(advanced.value, state[Field::position][i].w);
        state[Field::position_remainder][i] = texel(advanced.remainder);
    }
}

std::vector<TwinRow> common_rows() {
    return {{StepKind::stiffness, run_stiffness}, {StepKind::wind, run_wind},
            {StepKind::force, run_force},         {StepKind::pin, run_pin},
            {StepKind::spring, run_spring},       {StepKind::tether, run_tether},
            {StepKind::advance, run_advance}};
}

using StepFunction = void (*)(const TwinPlace&);
/// Returns the function of a step by its kind. Throws std::out_of_range for a step that does several plain ones at
/// once.
StepFunction function_of(StepKind kind) {
    static const std::map<StepKind, StepFunction> functions = [] {
        std::map<StepKind, StepFunction> all;
        for (const auto& rows :
             {common_rows(), twin_release_rows(), twin_explicit_rows(), twin_line_rows(), twin_nested_rows(),
              twin_bend_rows(), twin_contact_rows(), twin_check_rows(), twin_sheet_rows(), twin_rotation_rows(),
              twin_impulse_rows(), twin_seam_rows(), twin_gas_rows()})
            for (const TwinRow& row : rows) all.emplace(row.kind, row.run);
        return all;
    }();
    return functions.at(kind);
}

}  // namespace

void Twin::run_step(const Step& step, FrameInputs& inputs) {
    if (step.kind == StepKind::body_meet) return meet_bodies(step, inputs);
    if (step.kind == StepKind::body_move) return move_bodies(step, inputs);
    if (step.kind == StepKind::body_strike) return strike_bodies(step);
    if (step.cloth == between_cloths) return run_contact(step);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        if (step.cloth != all_cloths && step.cloth != cloth) continue;
        if (step.conditional && !cloths_[cloth].iterates) continue;
        function_of(step.kind)({*model_, model_->cloths[cloth], cloths_[cloth], step, inputs, inputs.pins[cloth],
                                contact_ ? &*contact_ : nullptr});
    }
}

void Twin::sew_normals() {
    for (const Step& step : normal_steps(*model_)) run_step(step, {});
}

void Twin::normals(std::size_t index) {
    TwinCloth& state = cloths_[index];
    const Grid& grid = state.topology.grid();
    for (int y = 0; y < grid.size().y; ++y)
        for (int x = 0; x < grid.size().x; ++x) {
            vec3 sum = empty_sum();
            for_triangles_around(grid, {x, y}, [&](ivec2 cell, int which) {
                vec3 corner[3];
                for (int k = 0; k < 3; ++k) {
                    const ivec2 offset = triangle_corner(which, k);
                    corner[k] = xyz(state[Field::position][at(grid, {cell.x + offset.x, cell.y + offset.y})]);
                }
                sum = add_area_vector(sum, corner[0], corner[1], corner[2]);
            });
            state[Field::normal][at(grid, {x, y})] = texel(unit_or_zero(sum));
        }
}

}  // namespace drape
