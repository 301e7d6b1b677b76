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

void run_torque(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<RotationPush>();
    const std::size_t first = arm_origin(model, push), count = state[Field::position].size();
    const vec3 start = xyz(state[Field::position][first]), moved = xyz(state[Field::displacement][first]);
    const bool is_bdf2 = state.integers(Field::line_control)[control_order] == 2u;
    for (std::size_t group = 0; group < static_cast<std::size_t>(push.sum_count); ++group) {
        TorqueLanes lanes;
        lanes.fill(empty_torque());
        const std::size_t begin = group * torque_particles;
        for (std::size_t i = begin; i < std::min(begin + torque_particles, count); ++i) {
            const vec4 position = state[Field::position][i];
            TorqueSum& lane = lanes[(i - begin) % workgroup_width];
            lane = joined(lane, torque_on(position, start, state[Field::displacement][i], moved,
                                          xyz(state[Field::displacement_before][i]), xyz(state.force_on(i)),
                                          scene.windy, is_bdf2, push));
        }
        const TorqueSum sum = joined_lanes(lanes);
        std::vector<vec4>& torques = state[Field::torques];
        torques[torque_texels * group] = sum.moment;
        torques[torque_texels * group + 1] = sum.impulse;
        torques[torque_texels * group + 2] = sum.torque;
        torques[torque_texels * group + 3] = sum.products;
    }
}

void run_rotate(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<RotationPush>();
    TorqueLanes lanes;
    lanes.fill(empty_torque());
    const std::vector<vec4>& torques = state[Field::torques];
    for (std::size_t i = 0; i < static_cast<std::size_t>(push.sum_count); ++i) {
        const TorqueSum sum(torques[torque_texels * i], torques[torque_texels * i + 1], torques[torque_texels * i + 2],
                            torques[torque_texels * i + 3]);
        lanes[i % workgroup_width] = joined(lanes[i % workgroup_width], sum);
    }
    const vec4 first = state[Field::position][arm_origin(model, push)];
    const Rotation rotation = rotation_of(joined_lanes(lanes), push.axis, first.w == 0.0f);
    vec4& taken = state[Field::angular_error][0];
    taken = texel((step.substep > 0 ? xyz(taken) : vec3{-0.0f, -0.0f, -0.0f}) + rotation.taken);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const vec4 position = state[Field::position][i];
        if (position.w == 0.0f) continue;
        state.move_to(i, rotated(rotation, xyz(position) - xyz(first), xyz(state[Field::displacement][i])));
    }
}

}  // namespace

std::vector<TwinRow> twin_rotation_rows() { return {{StepKind::torque, run_torque}, {StepKind::rotate, run_rotate}}; }

}  // namespace drape
