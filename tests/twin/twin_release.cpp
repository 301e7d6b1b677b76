// The twin releases pins, and has them take particles.
#include <algorithm>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// Returns the displacement by which the tension of a particle's springs would move an inner particle in a substep, m.
vec3 pull_of_springs(const ClothModel& model, const TwinCloth& state, ivec2 here, bool advance) {
    const auto start = [&](ivec2 p) { return xyz(state[Field::position][at(model.grid, p)]); };
    const auto moved = [&](ivec2 p) { return xyz(state[Field::displacement][at(model.grid, p)]); };
    vec3 sum{0, 0, 0};
    for (int k = 0; k < neighbour_count; ++k) {
        const ivec4 around = neighbour(k);
        const ivec2 offset{around.x, around.y}, there{here.x + around.x, here.y + around.y};
        if (there.x < 0 || there.y < 0 || there.x >= model.grid.size().x || there.y >= model.grid.size().y) continue;
        const vec3 edge =
            advance ? spring_edge(start(here), start(there), moved(here), moved(there)) : start(there) - start(here);
        const ivec2 owner = around.w == 1 ? here : there;
        const std::size_t i = at(model.grid, owner);
        const float share = state.topology.masked() ? component(state.topology.spring_shares()[i], around.z)
                                                    : border_share(owner, offset, model.grid.size());
        sum = add_tension_pull(sum, edge, state.tension(static_cast<std::size_t>(around.z))[i],
                               component(model.scheme.release_stiffness, around.z) * share);
    }
    return sum;
}

void run_release(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const std::size_t first = step.substep * model.dynamic_pins.size();
    const std::vector<vec4> position = state[Field::position];
    for (const PinnedParticle& pin : model.pinned) {
        const PinMotion& motion = motions[first + static_cast<std::size_t>(pin.index.z)];
        const ivec2 here{pin.index.x, pin.index.y};
        const std::size_t i = at(model.grid, here);
        if (pin.rest.w == 0.0f || !is_pinned(motion, here)) continue;
        const bool holds = motion.held.x != 0.0f;
        if (holds == (position[i].w == 0.0f)) continue;
        state[Field::position][i].w = holds ? 0.0f : pin.rest.w;
        if (model.scheme.second_order) {
            uint& hold = state.integers(Field::line_control)[control_hold];
            hold = std::max(hold, line_hold_release);
        }
        if (holds) continue;
        const vec3 nothing{0, 0, 0}, displacement = xyz(state[Field::displacement][i]);
        const vec3 pull =
            model.scheme.release_stiffness.x > 0 ? pull_of_springs(model, state, here, step.substep > 0) : nothing;
        const float surplus = release_surplus(motion);
        const vec3 now = step.substep > 0 ? xyz(position[i]) + displacement : xyz(position[i]);
        const vec3 velocity_step = pin_target(motion, motion.held.z != 0.0f ? now : xyz(pin.rest)) - displacement;
        state[Field::displacement][i].w = release_mark(surplus);
        state[Field::displacement_remainder][i] =
            texel(release_remainder(velocity_step, pin.rest.w, surplus, pull, model.reach()));
    }
}

}  // namespace

std::vector<TwinRow> twin_release_rows() { return {{StepKind::release, run_release}}; }

}  // namespace drape
