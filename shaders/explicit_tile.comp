// This kernel takes some explicit steps at once, none of them a frame's first, with the same bits as that many
// dispatches of explicit.comp. It is for devices that run many invocations: a workgroup holds a tile of particles, one
// per invocation, and shows them to each other in shared memory after every step. The outermost particles lack
// neighbours, so their error spreads inwards by one particle a step; therefore tiles overlap by 2 * `halo`, and one
// that holds the whole cloth needs none. `masked` is that of explicit.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/tile_types.h"
#include "include/explicit.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"
#include "include/wind.h"
CLOTH_CONSTANTS(ExplicitPush)
#define TOGETHER
#include "include/state_store.h"

const int tile_width = explicit_tile_width;
layout(local_size_x = tile_width, local_size_y = tile_width) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
VECTOR_OUT(1, position_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(3, displacement_out);
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D position_remainder_in;
VECTOR_OUT(5, position_remainder_out);
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D displacement_remainder_in;
VECTOR_OUT(7, displacement_remainder_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 8, rgba32f) uniform readonly image2D spring_shares;

layout(constant_id = 0) const bool has_shear = false;
layout(constant_id = 1) const int steps = 1;
layout(constant_id = 2) const int halo = 1;
#include "include/rest_length.h"
#include "include/tile.h"

struct Particle {
    vec3 position;
    float weight;
    vec3 displacement;
    float mark;  // beside the displacement (verlet.h)
    vec3 position_remainder;
    vec3 displacement_remainder;
};

// Every particle of the tile writes its position and displacement here; the displacement's y and z are in `shown_too`.
shared vec4 shown[tile_width * tile_width];
shared vec2 shown_too[tile_width * tile_width];

Particle load_particle(ivec2 texel) {
    vec4 position = LOAD(position_in, texel), moved = LOAD(displacement_in, texel);
    return Particle(position.xyz, position.w, moved.xyz, moved.w, LOAD(position_remainder_in, texel).xyz,
                    LOAD(displacement_remainder_in, texel).xyz);
}

void show(Particle particle) {
    barrier();  // all invocations have read the previous step's values
    shown[gl_LocalInvocationIndex] = vec4(particle.position, particle.displacement.x);
    shown_too[gl_LocalInvocationIndex] = particle.displacement.yz;
    barrier();
}

float share_of(ivec2 owner, ivec2 offset, int channel) {
    if (masked) return LOAD(spring_shares, owner)[channel];
    return border_share(owner, offset, push.grid);
}

/// Adds the pull of the spring to neighbour k.
vec3 gather(vec3 sum, Particle center, ivec2 texel, int k) {
    ivec4 around = neighbour(k);
    if (around.z >= 2 && !has_shear) return sum;
    ivec2 place = own_place() + around.xy, there = texel + around.xy;
    if (!within(there, push.grid) || !within(place, ivec2(tile_width))) return sum;
    int index = place.y * tile_width + place.x;
    vec4 first = shown[index];
    vec3 displacement = vec3(first.w, shown_too[index]);
    precise vec3 closing = displacement - center.displacement;
    ivec2 owner = around.w == 1 ? texel : there;
    precise float stiffness = push.relative_stiffness[around.z] * share_of(owner, around.xy, around.z);
    vec3 edge = spring_edge(center.position, first.xyz, center.displacement, displacement);
    return add_pull(sum, spring_pull(edge, closing, length_at_rest(push.rest_length[around.z], owner, around.z), stiffness,
                                     push.compression.x, push.strain_damping));
}

vec3 pull_on(Particle center, ivec2 texel) {
    vec3 pull = empty_sum();
    for (int k = 0; k < neighbour_count; ++k) pull = gather(pull, center, texel, k);
    return pull;
}

Particle stepped(Particle particle, vec3 pull) {
    CompensatedSum advanced = compensated_add(particle.position, particle.displacement, particle.position_remainder);
    particle.position = advanced.value;
    particle.position_remainder = advanced.remainder;
    vec3 increment = explicit_increment(particle.displacement, push.gravity_step.xyz, vec3(0.0f, 0.0f, 0.0f), pull,
                                        particle.weight, push.force_step, push.damping_loss);
    CompensatedSum moved = compensated_add(particle.displacement, released_increment(increment, particle.mark),
                                           particle.displacement_remainder);
    if (particle.weight != 0.0f) {
        particle.displacement = moved.value;
        particle.displacement_remainder = moved.remainder;
    }
    particle.mark = 0.0f;
    return particle;
}

void main() {
    ivec2 texel = own_texel();
    bool exists = within(texel, push.grid);
    Particle particle = load_particle(loaded_texel());
    for (int step = 0; step < steps; ++step) {
        show(particle);
        if (exists) particle = stepped(particle, pull_on(particle, texel));
    }
    if (!is_own()) return;
    STORE_VECTOR(position_out, texel, vec4(particle.position, particle.weight));
    STORE_VECTOR(displacement_out, texel, vec4(particle.displacement, 0.0f));
    STORE_VECTOR(position_remainder_out, texel, vec4(particle.position_remainder, 0.0f));
    STORE_VECTOR(displacement_remainder_out, texel, vec4(particle.displacement_remainder, 0.0f));
}
