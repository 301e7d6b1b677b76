// This pass moves particles back that are farther from their anchors than the cloth reaches. Anchors are held particles
// (w = 0), which it does not move; an anchor that was released holds no particle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/tether_types.h"
#include "include/places.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/tether.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer tethers;  // bits of ParticleTethers

/// Returns the edge from a tether's anchor to its particle, or 0, which never pulls, where there is no tether or its
/// anchor was released.
vec3 tether_edge(vec3 start, vec3 displacement, int anchor) {
    ivec2 at = texel_of(max(anchor, 0), push.grid.x);
    vec4 held = LOAD(position, at);
    vec3 edge = spring_edge(held.xyz, start, LOAD(displacement_in, at).xyz, displacement);
    return anchor >= 0 && held.w == 0.0f ? edge : vec3(0.0f, 0.0f, 0.0f);
}

/// Returns whether a tether pulls at a particle. The second tether pulls after the first, so if neither pulls now,
/// neither will.
bool is_pulled(ivec2 texel) {
    vec4 start = LOAD(position, texel);
    vec3 displacement = LOAD(displacement_in, texel).xyz;
    vec4 mine = imageLoad(tethers, placed(texel).y * push.grid.x + texel.x);
    bool by_first = is_beyond(tether_edge(start.xyz, displacement, floatBitsToInt(mine.x)), mine.z);
    bool by_second = is_beyond(tether_edge(start.xyz, displacement, floatBitsToInt(mine.y)), mine.w);
    return start.w != 0.0f && (by_first || by_second);
}

vec3 tethered(vec3 start, vec3 displacement, int anchor, float length) {
    return moved_by(displacement, tether_correction(tether_edge(start, displacement, anchor), length), 1.0f);
}

void pull(ivec2 texel) {
    vec3 start = LOAD(position, texel).xyz;
    vec4 before = LOAD(displacement_in, texel);
    vec4 mine = imageLoad(tethers, placed(texel).y * push.grid.x + texel.x);
    vec3 moved = tethered(start, before.xyz, floatBitsToInt(mine.x), mine.z);
    moved = tethered(start, moved, floatBitsToInt(mine.y), mine.w);
    STORE_VECTOR(displacement_out, texel, vec4(moved, before.w));
}

void main() { FOR_STRIP_FOUND(texel, push.grid, is_pulled(texel), pull(texel)) }
