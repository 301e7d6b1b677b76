// The explicit micro-step of the twin.
#include "reference/kernels.h"
#include "reference/texels.h"
#include "reference/twin.h"

namespace drape {

using namespace glsl;

namespace {

bool inside(ivec2 p, ivec2 grid) { return p.x >= 0 && p.y >= 0 && p.x < grid.x && p.y < grid.y; }

/// The images that a micro-step reads.
struct Before {
    const ClothModel& model;
    const TwinCloth& state;
    bool advance;

    vec3 edge(std::size_t from, std::size_t to) const {
        const vec3 first = xyz(state.position[from]), second = xyz(state.position[to]);
        return advance ? spring_edge(first, second, xyz(state.displacement[from]), xyz(state.displacement[to]))
                       : second - first;
    }
    float share(ivec2 here, ivec2 there, ivec4 around) const {
        const ivec2 owner = around.w == 1 ? here : there;
        return model.masked ? component(model.stiffness[at(model.grid, owner)], around.z)
                            : border_stiffness(owner, {around.x, around.y}, model.grid.size());
    }
    vec3 pull(ivec2 here) const {
        const ExplicitPush& push = model.explicit_step;
        const std::size_t i = at(model.grid, here);
        vec3 sum = empty_sum();
        for (int k = 0; k < neighbour_count; ++k) {
            const ivec4 around = neighbour(k);
            if (around.z >= 2 && push.stiffness.z == 0.0f) continue;
            const ivec2 there{here.x + around.x, here.y + around.y};
            if (!inside(there, push.grid)) continue;
            const std::size_t j = at(model.grid, there);
            const vec3 closing = xyz(state.displacement[j]) - xyz(state.displacement[i]);
            const float stiffness = component(push.stiffness, around.z) * share(here, there, around);
            sum = add_pull(sum, edge(i, j), closing, component(push.rest_length, around.z), stiffness,
                           push.strain_damping);
        }
        return sum;
    }
};

}  // namespace

void Twin::explicit_step(const ClothModel& model, TwinCloth& state, bool advance) {
    const ExplicitPush& push = model.explicit_step;
    const Before before{model, state, advance};
    std::vector<vec4>& position_out = state.position_spare;
    std::vector<vec4>& displacement_out = state.displacement_spare;
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const std::size_t i = at(model.grid, {x, y});
            const vec4 position = state.position[i];
            const vec3 displacement = xyz(state.displacement[i]);
            position_out[i] = position;
            displacement_out[i] = texel(displacement);
            if (advance) {
                const CompensatedSum advanced =
                    compensated_add(xyz(position), displacement, xyz(state.position_rest[i]));
                position_out[i] = texel(advanced.value, position.w);
                state.position_rest[i] = texel(advanced.rest);
            }
            if (position.w == 0.0f) continue;
            const vec3 applied = state.wind_force.empty() ? vec3{0, 0, 0} : xyz(state.wind_force[i]);
            const vec3 increment =
                explicit_increment(displacement, xyz(push.gravity_step), applied, before.pull({x, y}), position.w,
                                   push.force_step, push.damping_loss);
            const CompensatedSum stepped = compensated_add(displacement, increment, xyz(state.displacement_rest[i]));
            displacement_out[i] = texel(stepped.value);
            state.displacement_rest[i] = texel(stepped.rest);
        }
    std::swap(state.position, state.position_spare);
    std::swap(state.displacement, state.displacement_spare);
}

}  // namespace drape
