// The twin keeps a cloth's angular momentum.
#include <algorithm>
#include <array>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

using TorqueLanes = std::array<TorqueSum, workgroup_width>;

TorqueSum joined_lanes(TorqueLanes& lanes) {
    for (std::size_t stride = workgroup_width / 2; stride > 0; stride /= 2)
        for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = joined(lanes[lane], lanes[lane + stride]);
    return lanes[0];
}

std::size_t arm_origin(const ClothModel& model, const RotationPush& push) { return at(model.grid, push.about); }

/// Stores the sum of each workgroup, of the terms that `torque_of` gives for particles.
template <class TorqueOf>
void sum_torques(TwinCloth& state, int sum_count, const TorqueOf& torque_of) {
    const std::size_t count = state[Field::position].size();
    for (std::size_t group = 0; group < static_cast<std::size_t>(sum_count); ++group) {
        TorqueLanes lanes;
        lanes.fill(empty_torque());
        const std::size_t begin = group * torque_particles;
        for (std::size_t i = begin; i < std::min(begin + torque_particles, count); ++i) {
            TorqueSum& lane = lanes[(i - begin) % workgroup_width];
            lane = joined(lane, torque_of(i));
        }
        const TorqueSum sum = joined_lanes(lanes);
        std::vector<vec4>& torques = state[Field::torques];
        torques[torque_texels * group] = sum.moment;
        torques[torque_texels * group + 1] = sum.impulse;
        torques[torque_texels * group + 2] = sum.torque;
        torques[torque_texels * group + 3] = sum.products;
    }
}

TorqueSum joined_sums(const TwinCloth& state, int sum_count) {
    TorqueLanes lanes;
    lanes.fill(empty_torque());
    const std::vector<vec4>& torques = state[Field::torques];
    for (std::size_t i = 0; i < static_cast<std::size_t>(sum_count); ++i) {
        const TorqueSum sum(torques[torque_texels * i], torques[torque_texels * i + 1], torques[torque_texels * i + 2],
                            torques[torque_texels * i + 3]);
        lanes[i % workgroup_width] = joined(lanes[i % workgroup_width], sum);
    }
    return joined_lanes(lanes);
}

void run_torque(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<RotationPush>();
    const std::size_t first = arm_origin(model, push);
    const vec3 start = xyz(state[Field::position][first]), moved = xyz(state[Field::displacement][first]);
    const bool is_bdf2 = model.scheme.second_order && state.integers(Field::line_control)[control_order] == 2u;
    sum_torques(state, push.sum_count, [&](std::size_t i) {
        return torque_on(state[Field::position][i], start, state[Field::displacement][i], moved,
                         xyz(state[Field::displacement_before][i]), xyz(state.force_on(i)), scene.windy, is_bdf2, push);
    });
}

void run_rotate(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<RotationPush>();
    const vec4 first = state[Field::position][arm_origin(model, push)];
    const Rotation rotation = rotation_of(joined_sums(state, push.sum_count), push.axis, first.w == 0.0f);
    vec4& taken = state[Field::angular_error][0];
    taken = texel((step.substep > 0 ? xyz(taken) : vec3{-0.0f, -0.0f, -0.0f}) + rotation.taken);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const vec4 position = state[Field::position][i];
        if (position.w == 0.0f) continue;
        state.move_to(i, rotated(rotation, xyz(position) - xyz(first), xyz(state[Field::displacement][i])));
    }
}

/// Returns where a particle lies on the sheet.
std::size_t laid_at(const ContactTurnPush& push, ivec2 texel) {
    return static_cast<std::size_t>(push.first.y + texel.y) * static_cast<std::size_t>(push.sheet.x) +
           static_cast<std::size_t>(push.first.x + texel.x);
}

void run_self_couples(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<ContactTurnPush>();
    const vec3 start = xyz(meeting->positions[laid_at(push, push.about)]);
    sum_torques(state, push.sum_count, [&](std::size_t i) {
        const auto particle = static_cast<int>(i);
        const std::size_t laid = laid_at(push, {particle % push.grid.x, particle / push.grid.x});
        const vec4 now = state[Field::position][i];
        const vec3 moved = xyz(state[Field::displacement][i]), at_start = xyz(meeting->positions[laid]);
        const vec3 halves = summed(meeting->sums[laid], self_sum_of_couples, push.largest);
        return contact_torque_on(arm_at_end(xyz(now), moved, start), now.w, way_between(at_start, xyz(now)), moved,
                                 self_couple_of(halves, push.largest, push.lightness));
    });
}

void run_self_turn(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<ContactTurnPush>();
    const vec4 about = meeting->positions[laid_at(push, push.about)];
    std::vector<vec4>& kept = state[Field::paid];
    const vec3 paid = step.substep > 0 ? xyz(kept[static_cast<std::size_t>(push.paid)]) : vec3{};
    const TorqueSum sum = joined_sums(state, push.sum_count);
    const Rotation rotation = rotation_of(contact_owed(sum, paid, step.last), push.axis, about.w == 0.0f);
    if (!step.last) {
        const Rotation ahead = rotation_of(contact_advance(sum), push.axis, about.w == 0.0f);
        kept[static_cast<std::size_t>(1 - push.paid)] = texel(xyz(sum.torque));
        kept[paid_turn] = texel(ahead.turn);
        kept[paid_turn + 1] = texel(turned_about(ahead, xyz(about)));
    }
    if (rotation.turn.x == 0.0f && rotation.turn.y == 0.0f && rotation.turn.z == 0.0f) return;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const vec4 position = state[Field::position][i];
        if (position.w == 0.0f) continue;
        const vec3 moved = xyz(state[Field::displacement][i]);
        const vec3 by = turned_by(rotation, arm_at_end(xyz(position), moved, xyz(about)));
        vec4& remainder = state[Field::position_remainder][i];
        remainder = texel(without_turn(xyz(remainder), by));
        state.move_to(i, with_turn(moved, by));
        if (!step.last) continue;
        vec4& before = where.before()[i];
        before = texel(with_turn(xyz(before), by), before.w);
    }
}

}  // namespace

std::vector<TwinRow> twin_rotation_rows() {
    return {{StepKind::torque, run_torque},
            {StepKind::rotate, run_rotate},
            {StepKind::self_couples, run_self_couples},
            {StepKind::self_turn, run_self_turn}};
}

}  // namespace drape
