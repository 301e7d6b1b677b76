// The images and compensated sums for passes that carry a cloth's state from substep to substep, which advance position
// and displacement. Where `windy`, the wind's force is one of the images. The includer has verlet.h, `push.grid` and
// `in_place`: whether the pass writes the images that it reads, except for the displacement of some predictions.
#include "include/state_store.h"
#define STATE_OUT(slot, name) \
    TRIPLE_OUT(slot, name);   \
    VIEW(writeonly, slot, vec4, name, vectors)
#define STORE_STATE(name, texel, value, beside)            \
    {                                                      \
        if (in_place)                                      \
            STORE_TRIPLE(name, texel, value, beside)       \
        else                                               \
            STORE_VECTOR(name, texel, vec4(value, beside)) \
    }

layout(local_size_x = workgroup_width) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
STATE_OUT(1, position_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(3, displacement_out);
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D position_remainder_in;
STATE_OUT(5, position_remainder_out);
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D displacement_remainder_in;
VECTOR_OUT(7, displacement_remainder_out);
layout(constant_id = 23) const bool windy = false;
VECTOR_OF(readonly, 8, wind_force);  // by its view, so that no stage has more than 8 images

void advance_position(ivec2 texel, vec4 position, vec3 displacement) {
    CompensatedSum advanced = compensated_add(position.xyz, displacement, LOAD(position_remainder_in, texel).xyz);
    STORE_STATE(position_out, texel, advanced.value, position.w);
    STORE_STATE(position_remainder_out, texel, advanced.remainder, 0.0f);
}

/// Adds `increment` to a displacement, minus the share `loss` that the wind's drag takes away. `displacement.w` is the
/// mark (verlet.h).
void step_displacement(ivec2 texel, vec4 displacement, vec3 increment, float loss) {
    vec3 counted = dragged_increment(released_increment(increment, displacement.w), loss);
    CompensatedSum stepped = compensated_add(displacement.xyz, counted, LOAD(displacement_remainder_in, texel).xyz);
    STORE_VECTOR(displacement_out, texel, vec4(stepped.value, loss));
    STORE_VECTOR(displacement_remainder_out, texel, vec4(stepped.remainder, 0.0f));
}

/// Returns the force on the particle of a texel, N; w: its drag, N/m.
vec4 force_on(ivec2 texel) {
    vec4 force = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    if (windy) LOAD_VECTOR(force, wind_force, texel)
    return force;
}
