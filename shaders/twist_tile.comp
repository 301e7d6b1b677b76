// This kernel is a step of all twist, with the same bits as the four passes of twist.comp, for devices that run many
// invocations: a workgroup holds a tile of particles in shared memory (include/tile.h) and takes the colours in turn,
// each cell by the invocation of its upper left particle. What is missing beyond a tile's border reaches inwards by one
// particle a colour. `masked` and `second_order` are those of twist.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "shared/tile_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(AllTwistPush)
#define TOGETHER
#include "include/state_store.h"

const int tile_width = sweep_tile_width;
layout(local_size_x = tile_width, local_size_y = tile_width) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
#include "include/bend_target.h"
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D line_control;

layout(constant_id = 0) const int halo = 0;
#include "include/tile.h"

// The tile's particles have position and inverse mass in one array and displacement in the other.
shared vec4 held[tile_width * tile_width];
shared vec3 moved[tile_width * tile_width];

float share_of(ivec2 cell) {
    if (masked) return twist_share(LOAD(spring_shares, cell), LOAD(spring_shares, cell + ivec2(1, 0)),
                           LOAD(spring_shares, cell + ivec2(0, 1)));
    return 1.0f;
}

vec3 edge_between(int a, int b) { return spring_edge(held[a].xyz, held[b].xyz, moved[a], moved[b]); }

/// Relaxes the cells whose upper left particles have these parities of column and row.
void relax(ivec2 colour, float compliance) {
    barrier();
    ivec2 cell = own_texel(), last = own_place() + 1;
    if ((cell & 1) != colour || !within(cell, push.grid - 1) || !within(last, ivec2(tile_width))) return;
    int upper_left = int(gl_LocalInvocationIndex), upper_right = upper_left + 1;
    int lower_left = upper_left + tile_width, lower_right = lower_left + 1;
    vec3 difference = twist_difference(edge_between(upper_left, upper_right), edge_between(lower_left, lower_right));
    difference = beyond_rest(difference, bend_target(cell, 2));
    float weight =
        twist_weight(held[upper_left].w, held[upper_right].w, held[lower_left].w, held[lower_right].w);
    vec3 correction = project_bend(difference, weight, share_of(cell), compliance);
    moved[upper_left] = moved_by(moved[upper_left], correction, held[upper_left].w);
    moved[upper_right] = moved_by(moved[upper_right], correction, -held[upper_right].w);
    moved[lower_left] = moved_by(moved[lower_left], correction, -held[lower_left].w);
    moved[lower_right] = moved_by(moved[lower_right], correction, held[lower_right].w);
}

void main() {
    float compliance = push.compliance;
    if (second_order)
        if (imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u) compliance = push.compliance_bdf2;
    ivec2 texel = loaded_texel();
    vec4 start = LOAD(position, texel), displacement = LOAD(displacement_in, texel);
    held[gl_LocalInvocationIndex] = vec4(start.xyz, dragged_weight(start.w, displacement.w));
    moved[gl_LocalInvocationIndex] = displacement.xyz;
    relax(ivec2(0, 0), compliance);
    relax(ivec2(1, 0), compliance);
    relax(ivec2(0, 1), compliance);
    relax(ivec2(1, 1), compliance);
    barrier();
    if (is_own()) STORE_VECTOR(displacement_out, texel, vec4(moved[gl_LocalInvocationIndex], displacement.w));
}
