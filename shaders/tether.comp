// Takes particles back that are farther from their anchors than the cloth reaches. Anchors are held particles (w = 0),
// which this pass does not move; one that was released holds nobody.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/simulation_types.h"
#include "shared/tether_types.h"
#include "include/spring.h"
#include "include/tether.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { GridPush push; };
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, DisplacementOut, displacement_out);
layout(set = 0, binding = 3, std430) readonly buffer Tethers { ParticleTethers tethers[]; };

vec3 tethered(vec3 start, vec3 displacement, int anchor, float length) {
    if (anchor < 0) return displacement;
    ivec2 at = ivec2(anchor % push.grid.x, anchor / push.grid.x);
    vec4 held = imageLoad(position, at);
    if (held.w != 0.0f) return displacement;
    vec3 edge = spring_edge(held.xyz, start, imageLoad(displacement_in, at).xyz, displacement);
    return moved_by(displacement, tether_correction(edge, length), 1.0f);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 start = imageLoad(position, texel);
    if (start.w == 0.0f) return;
    ParticleTethers mine = tethers[texel.y * push.grid.x + texel.x];
    vec4 before = imageLoad(displacement_in, texel);
    vec3 moved = tethered(start.xyz, before.xyz, mine.anchor_a, mine.length_a);
    moved = tethered(start.xyz, moved, mine.anchor_b, mine.length_b);
    if (moved != before.xyz) STORE_VECTOR(displacement_out, texel, vec4(moved, before.w));
}
