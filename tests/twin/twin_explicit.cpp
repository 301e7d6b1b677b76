// The twin takes explicit steps.
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

bool inside(ivec2 p, ivec2 grid) { return p.x >= 0 && p.y >= 0 && p.x < grid.x && p.y < grid.y; }

/// An explicit step reads the fields through this, as they are before it.
struct Before {
    const TwinCloth& state;
    const ExplicitPush& push;
    bool advance;

    std::size_t index(ivec2 p) const { return at(state.topology.grid(), p); }
    vec3 edge(ivec2 from, ivec2 to) const {
        const vec3 first = xyz(state[Field::position][index(from)]), second = xyz(state[Field::position][index(to)]);
        return advance ? spring_edge(first, second, xyz(state[Field::displacement][index(from)]),
                                     xyz(state[Field::displacement][index(to)]))
                       : second - first;
    }
    float share(ivec2 owner, ivec2 offset, int channel) const {
        return state.topology.masked() ? component(state.topology.spring_shares()[index(owner)], channel)
                                       : border_share(owner, offset, push.grid);
    }
    vec3 with_springs(vec3 sum, ivec2 here) const {
        for (int k = 0; k < neighbour_count; ++k) {
            const ivec4 around = neighbour(k);
            if (around.z >= 2 && push.relative_stiffness.z == 0.0f) continue;
            const ivec2 offset{around.x, around.y}, there{here.x + around.x, here.y + around.y};
            if (!inside(there, push.grid)) continue;
            const vec3 closing =
                xyz(state[Field::displacement][index(there)]) - xyz(state[Field::displacement][index(here)]);
            const float relative_stiffness =
                component(push.relative_stiffness, around.z) * share(around.w == 1 ? here : there, offset, around.z);
            const float rest = state.topology.cloth().rest_length(component(push.rest_length, around.z),
                                                                  index(around.w == 1 ? here : there), around.z);
            sum = add_pull(sum, spring_pull(edge(here, there), closing, rest, relative_stiffness, push.compression.x,
                                            push.strain_damping));
        }
        return sum;
    }
    vec3 with_element(vec3 sum, ivec2 middle, int axis, float factor) const {
        const ivec2 offset = bend_axes[static_cast<std::size_t>(axis)].offset;
        const ivec2 first{middle.x - offset.x, middle.y - offset.y}, third{middle.x + offset.x, middle.y + offset.y};
        if (!inside(first, push.grid) || !inside(third, push.grid)) return sum;
        const float shared = bend_share(share(first, offset, axis), share(middle, offset, axis));
        const vec3 difference = second_difference(edge(middle, first), edge(middle, third));
        return add_bend(sum, beyond_rest(difference, state.bend_target(middle, axis)), factor * shared);
    }
    vec3 with_cell(vec3 sum, ivec2 corner, float factor) const {
        const ivec2 right{corner.x + 1, corner.y}, below{corner.x, corner.y + 1}, across{corner.x + 1, corner.y + 1};
        if (!inside(corner, push.grid) || !inside(across, push.grid)) return sum;
        const std::vector<vec4>& shares = state.topology.spring_shares();
        const float whole = state.topology.masked()
                                ? twist_share(shares[index(corner)], shares[index(right)], shares[index(below)])
                                : 1.0f;
        const vec3 difference = twist_difference(edge(corner, right), edge(below, across));
        return add_bend(sum, beyond_rest(difference, state.bend_target(corner, 2)), factor * whole);
    }
    vec3 with_twist(vec3 sum, ivec2 here) const {
        const float twist = push.twist;
        if (twist == 0.0f) return sum;
        sum = with_cell(sum, {here.x - 1, here.y - 1}, -twist);
        sum = with_cell(sum, {here.x, here.y - 1}, twist);
        sum = with_cell(sum, {here.x - 1, here.y}, twist);
        return with_cell(sum, here, -twist);
    }
    vec3 with_bending(vec3 sum, ivec2 here) const {
        for (int axis = 0; axis < 2; ++axis) {
            const float bend = axis == 0 ? push.bend.x : push.bend.y;
            if (bend == 0.0f) continue;
            const ivec2 offset = bend_axes[static_cast<std::size_t>(axis)].offset;
            sum = with_element(sum, {here.x - offset.x, here.y - offset.y}, axis, -bend);
            sum = with_element(sum, here, axis, 2.0f * bend);
            sum = with_element(sum, {here.x + offset.x, here.y + offset.y}, axis, -bend);
        }
        sum = with_twist(sum, here);
        const bool rests_bent = !state[Field::bend_targets].empty() && push.twist != 0.0f;
        return rests_bent ? add_pull_of(sum, state.bend_pull(here), 1.0f) : sum;
    }
};

void run_explicit_step(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<ExplicitPush>();
    const bool advance = step.substep > 0;
    const Before before{state, push, advance};
    std::vector<vec4>& position_out = state[Field::position_spare];
    std::vector<vec4>& displacement_out = state[Field::displacement_spare];
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const std::size_t i = at(state.topology.grid(), {x, y});
            const vec4 position = state[Field::position][i];
            const vec3 displacement = xyz(state[Field::displacement][i]);
            position_out[i] = position;
            displacement_out[i] = texel(displacement);
            if (advance) {
                const CompensatedSum advanced =
                    compensated_add(xyz(position), displacement, xyz(state[Field::position_remainder][i]));
                position_out[i] = texel(advanced.value, position.w);
                state[Field::position_remainder][i] = texel(advanced.remainder);
            }
            if (position.w == 0.0f) continue;
            const vec4 applied = state.force_on(i);
            const vec3 increment =
                explicit_increment(displacement, xyz(push.gravity_step), xyz(applied),
                                   before.with_bending(before.with_springs(empty_sum(), {x, y}), {x, y}), position.w,
                                   push.force_step, push.damping_loss);
            const float loss = drag_loss(applied.w, position.w, push.force_step);
            const vec3 counted =
                dragged_increment(released_increment(increment, state[Field::displacement][i].w), loss);
            const CompensatedSum stepped =
                compensated_add(displacement, counted, xyz(state[Field::displacement_remainder][i]));
            displacement_out[i] = texel(stepped.value, loss);
            state[Field::displacement_remainder][i] = texel(stepped.remainder);
        }
    std::swap(state[Field::position], state[Field::position_spare]);
    std::swap(state[Field::displacement], state[Field::displacement_spare]);
}

}  // namespace

std::vector<TwinRow> twin_explicit_rows() { return {{StepKind::explicit_step, run_explicit_step}}; }

void Twin::tension(std::size_t index) {
    const ClothModel& model = model_->cloths[index];
    const TensionPush& push = model.scheme.gathered_tension.value();
    const Grid& grid = model.grid;
    TwinCloth& state = cloths_[index];
    const auto tension_to = [&](ivec2 first, ivec2 second, int channel) {
        const std::size_t a = at(grid, first), b = at(grid, second);
        return gathered_tension(xyz(state[Field::position][b]) - xyz(state[Field::position][a]),
                                xyz(state[Field::displacement][b]) - xyz(state[Field::displacement][a]),
                                model.rest_length(channel == 0 ? push.rest_length.x : push.rest_length.y, a, channel),
                                channel == 0 ? push.used_share.x : push.used_share.y, push.compression,
                                push.strain_damping);
    };
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const std::size_t i = at(grid, {x, y});
            if (x + 1 < push.grid.x) state.tension(0)[i] = tension_to({x, y}, {x + 1, y}, 0);
            if (y + 1 < push.grid.y) state.tension(1)[i] = tension_to({x, y}, {x, y + 1}, 1);
        }
}

}  // namespace drape
