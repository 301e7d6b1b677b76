// These passes of the twin are between a cloth's fields and the sheet on which contact sees all cloths.
#include <algorithm>
#include <utility>

#include "cloth/texels.h"
#include "reference/kernels.h"
#include "reference/twin.h"

namespace drape {

using namespace glsl;

namespace {

std::size_t place_of(const SelfClothPush& push, std::size_t particle) {
    const auto columns = static_cast<std::size_t>(push.grid.x);
    const std::size_t column = particle % columns, row = particle / columns;
    return (static_cast<std::size_t>(push.first.y) + row) * static_cast<std::size_t>(push.columns) +
           static_cast<std::size_t>(push.first.x) + column;
}

void run_self_gather(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SelfClothPush>();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const ivec2 own{static_cast<int>(i) % push.grid.x, static_cast<int>(i) / push.grid.x};
        const std::uint32_t triangles = cell_inside(own, push.grid) ? state.topology.grid().cell(own.x, own.y) : 0u;
        const std::size_t place = place_of(push, i);
        meeting->positions[place] = state[Field::position][i];
        meeting->displacements[place] = texel(xyz(state[Field::displacement][i]), static_cast<float>(triangles));
        if (!state[Field::support].empty())
            meeting->supports[place] = {std::exchange(state[Field::support][i], vec4{}), state[Field::support_grip][i]};
    }
}

void run_self_gather_again(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SelfClothPush>();
    meeting->led_ways.resize(meeting->before.size());
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const std::size_t place = place_of(push, i);
        vec4& laid = meeting->displacements[place];
        laid = texel(xyz(state[Field::displacement][i]), laid.w);
        const vec3 start = xyz(meeting->positions[place]), way = way_between(start, xyz(state[Field::position][i]));
        if (is_rounding(start, way)) continue;
        meeting->led_ways[place] = texel(way);
        meeting->before[place].w = meeting->before[place].w != 0.0f ? self_pushed_and_led : self_led_out;
    }
}

void run_self_hand(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SelfClothPush>();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const std::size_t place = place_of(push, i);
        if (meeting->before[place].w != 0.0f) state.move_to(i, xyz(meeting->displacements[place]));
    }
}

void run_self_return(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SelfClothPush>();
    const bool ends_frame = step.last && !state[Field::end_excess].empty();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const std::size_t place = place_of(push, i);
        if (meeting->before[place].w == 0.0f) continue;
        const vec3 velocity = xyz(meeting->velocities[place]);
        vec4& start = state[Field::position][i];
        start =
            texel(self_start(xyz(meeting->positions[place]), xyz(meeting->displacements[place]), velocity), start.w);
        state.move_to(i, velocity);
        if (meeting->before[place].w == self_pushed && (model.scheme.second_order || ends_frame)) {
            vec4& last = state[model.scheme.spare_state ? Field::displacement_spare : Field::displacement_before][i];
            last = texel(self_changed_alike(xyz(last), xyz(meeting->before[place]), velocity));
        }
        if (!model.scheme.second_order) continue;
        uint& hold = state.integers(Field::line_control)[control_hold];
        hold = std::max(hold, line_hold_contact);
    }
}

}  // namespace

std::vector<TwinRow> twin_sheet_rows() {
    return {{StepKind::self_gather, run_self_gather},
            {StepKind::self_gather_again, run_self_gather_again},
            {StepKind::self_hand, run_self_hand},
            {StepKind::self_return, run_self_return}};
}

}  // namespace drape
