// This kernel is a step of all springs, with the same bits as the eight passes of spring.comp, for devices that run
// many invocations: a workgroup holds a tile of particles in shared memory and takes the passes in turn. The outermost
// particles lack neighbours, so their error spreads inwards by one particle a pass; therefore tiles overlap by 2 *
// `halo`, and one that holds the whole cloth needs none. The constants are those of spring_stream.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/tile_types.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(AllSpringsPush)
#define TOGETHER
#include "include/state_store.h"

const int tile_width = sweep_tile_width;
layout(local_size_x = tile_width, local_size_y = tile_width) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
#include "include/iteration_tension.h"
#include "include/rest_length.h"

layout(constant_id = 0) const int directions = 15;  // bit d: there are springs of direction d
layout(constant_id = 1) const int halo = 0;
#include "include/tile.h"

// The tile's particles have position and inverse mass in one array and displacement in the other.
shared vec4 held[tile_width * tile_width];
shared vec3 moved[tile_width * tile_width];

float share_of(ivec2 owner, ivec2 offset, int channel) {
    if (masked) return LOAD(spring_shares, owner)[channel];
    return border_share(owner, offset, push.grid);
}

/// Takes one pass: it relaxes the springs of one direction and parity, each by the invocation of its first particle.
void relax(ivec2 offset, int channel, int parity) {
    barrier();
    ivec2 first = own_texel(), second = first + offset;
    int along = channel == 0 ? first.x : first.y;
    bool is_first = (along & 1) == parity && within(first, push.grid) && within(second, push.grid) &&
                    within(own_place() + offset, ivec2(tile_width));
    if (!is_first) return;
    int a = int(gl_LocalInvocationIndex), b = a + offset.y * tile_width + offset.x;
    vec4 held_a = held[a], held_b = held[b];
    vec3 edge = spring_edge(held_a.xyz, held_b.xyz, moved[a], moved[b]);
    precise float weight_sum = held_a.w + held_b.w;
    SpringResult result =
        project_spring(edge, weight_sum, length_at_rest(push.rest_length[channel], first, channel),
                       share_of(first, offset, channel), push.compression, push.compliance[channel],
                       tension_at(first, channel));
    moved[a] = moved_by(moved[a], result.correction, -held_a.w);
    moved[b] = moved_by(moved[b], result.correction, held_b.w);
    if (is_own()) store_tension_at(own_texel(), channel, result.tension);
}

void relax_direction(ivec2 offset, int channel) {
    if ((directions & (1 << channel)) == 0) return;
    relax(offset, channel, 0);
    relax(offset, channel, 1);
}

void main() {
    ivec2 texel = loaded_texel();
    vec4 start = LOAD(position, texel), displacement = LOAD(displacement_in, texel);
    held[gl_LocalInvocationIndex] = vec4(start.xyz, dragged_weight(start.w, displacement.w));
    moved[gl_LocalInvocationIndex] = displacement.xyz;
    relax_direction(ivec2(1, 0), 0);
    relax_direction(ivec2(0, 1), 1);
    relax_direction(ivec2(1, 1), 2);
    relax_direction(ivec2(-1, 1), 3);
    barrier();
    if (is_own()) STORE_VECTOR(displacement_out, texel, vec4(moved[gl_LocalInvocationIndex], displacement.w));
}
