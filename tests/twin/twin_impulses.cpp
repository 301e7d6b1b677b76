// The twin sums what changes a cloth's momentum in a frame.
#include "twin/twin_impulses.h"

#include <algorithm>

#include "cloth/cloth_statistics.h"
#include "cloth/directions.h"
#include "cloth/forces.h"
#include "cloth/texels.h"

namespace drape {

using namespace glsl;

namespace {

void run_clear_impulses(const TwinPlace& where) {
    std::vector<uint>& impulses = where.state.integers(Field::impulses);
    std::ranges::fill(impulses, 0u);
    impulses[impulse_head] = floatBitsToUint(where.step.push<ClearImpulsesPush>().units);
}

/// Returns what holds the springs of a particle, as if it acted for half of a frame.
vec3 held_springs(const TwinPlace& where, ivec2 texel) {
    const ClothModel& model = where.model;
    TwinCloth& state = where.state;
    const auto& push = where.step.push<MomentumPush>();
    vec3 sum{-0.0f, -0.0f, -0.0f};
    for (int k = 0; k < neighbour_count; ++k) {
        const ivec4 around = neighbour(k);
        const ivec2 there{texel.x + around.x, texel.y + around.y};
        const auto channel = static_cast<std::size_t>(around.z);
        const bool inside = there.x >= 0 && there.y >= 0 && there.x < push.grid.x && there.y < push.grid.y;
        if (!inside || component(push.rest_length, channel) == 0.0f) continue;
        const ivec2 owner = around.w == 1 ? texel : there;
        const std::size_t first = at(model.grid, owner);
        const float share = state.topology.masked() ? component(state.topology.spring_shares()[first], channel)
                                                    : border_share(owner, {around.x, around.y}, push.grid);
        const vec3 edge =
            xyz(state[Field::position][at(model.grid, there)]) - xyz(state[Field::position][at(model.grid, texel)]);
        const bool known = !model.scheme.spare_state && !state.tension(channel).empty();
        const float tension =
            known ? state.tension(channel)[first]
                  : tension_of_edge(edge, model.rest_length(component(push.rest_length, channel), first, channel),
                                    push.compression);
        sum = with_held_spring(sum, edge, tension, component(push.pull, channel) * share);
    }
    return sum;
}

void run_momentum(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<MomentumPush>();
    const std::vector<float> masses = mass_shares(model);
    const std::vector<uint> pins = pin_numbers(scene, static_cast<std::size_t>(&model - scene.cloths.data()));
    TwinImpulses impulses(state);
    if (push.sign < 0) std::ranges::fill(state[Field::contact_impulses], vec4{});
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const vec4 position = state[Field::position][i];
        const vec3 momentum =
            momentum_of(xyz(state[Field::displacement][i]), xyz(state[Field::end_excess][i]), masses[i]);
        impulses.add(impulse_momentum, 0, momentum, push.sign * impulses.units());
        impulses.add(impulse_momentum, 3, moment_of_mass(xyz(position), position.w == 0.0f ? 0.0f : masses[i]),
                     push.sign * travel_units);
        if (!splits_pins(scene) || position.w != 0.0f || pins[i] == 0) continue;
        const ivec2 texel{static_cast<int>(i) % push.grid.x, static_cast<int>(i) / push.grid.x};
        impulses.add(static_cast<int>(first_pin_row(scene.scene) + pins[i] - 1), 0, held_springs(where, texel),
                     impulses.units());
    }
}

void run_worst_impulses(const TwinPlace& where) {
    std::vector<uint>& impulses = where.state.integers(Field::impulses);
    const int rows = where.step.push<WorstImpulsesPush>().rows;
    const auto at = [&](int row, int number) -> uint* {
        return &impulses[static_cast<std::size_t>(row * impulse_columns + 2 * number)];
    };
    const auto words = [&](int row, int number) { return ImpulseWords{at(row, number)[0], at(row, number)[1]}; };
    const auto added = [&](int row, int number) {
        return words_difference(words(row, number), words(rows + row, number));
    };
    const auto put = [&](int row, int number, ImpulseWords value) {
        at(row, number)[0] = value.low;
        at(row, number)[1] = value.high;
    };
    for (int row = impulse_air; row < rows; ++row)
        for (const int first : {0, 3}) {
            const int worst = 2 * rows + row;
            const float now = squared_impulse(added(row, first), added(row, first + 1), added(row, first + 2));
            const float most = squared_impulse(words(worst, first), words(worst, first + 1), words(worst, first + 2));
            for (int number = first; number < first + 3; ++number) {
                if (now > most) put(worst, number, added(row, number));
                put(rows + row, number, words(row, number));
            }
        }
}

void run_self_impulses(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    TwinImpulses impulses(state);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const std::size_t place = place_on_sheet(step.push<SelfClothPush>(), i);
        const float inverse_mass = state[Field::position][i].w;
        if (meeting->before[place].w != self_pushed || !(inverse_mass > 0.0f)) continue;
        const vec3 motion = given_by_contact(xyz(meeting->velocities[place]), xyz(state[Field::displacement][i]));
        const vec3 impulse = impulse_of_motion(motion, reciprocal(inverse_mass));
        impulses.add(impulse_cloths, 0, impulse, impulses.units());
        if (std::vector<vec4>& sums = state[Field::contact_impulses]; !sums.empty())
            sums[i] = texel(more_impulse(xyz(sums[i]), impulse));
    }
}

}  // namespace

std::vector<TwinRow> twin_impulse_rows() {
    return {{StepKind::clear_impulses, run_clear_impulses},
            {StepKind::momentum, run_momentum},
            {StepKind::worst_impulses, run_worst_impulses},
            {StepKind::self_impulses, run_self_impulses}};
}

}  // namespace drape
