// This pass finds the springs and triangles that the cutters cross at the end of a frame: each particle tests the four
// springs that it owns and the two triangles of its cell against every active triangle of the cutters. Where
// `masked`, springs and triangles that are gone are left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/cut_types.h"
#include "include/cut.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(CutPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D cut_flags;  // 2 texels per cell: upper, lower triangle
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D cut_fractions;  // by owned spring; -1: not crossed
layout(set = 0, binding = 3, std430) readonly buffer Cutters { CutterTriangle cutters[]; };
layout(set = 0, binding = 4, std430) buffer Count { uint count[]; };  // number of springs crossed
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 6, r32ui) uniform readonly uimage2D cells;

vec3 particle(ivec2 at) { return imageLoad(position, at).xyz; }

float first_crossing(float found, vec3 p, vec3 q, CutterTriangle cutter) {
    if (found >= 0.0f) return found;
    return crossing_fraction(p, q, cutter.a.xyz, cutter.b.xyz, cutter.c.xyz);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    bool has_right = texel.x + 1 < push.grid.x;
    bool has_below = texel.y + 1 < push.grid.y;
    vec3 here = particle(texel);
    vec3 right = has_right ? particle(texel + ivec2(1, 0)) : here;
    vec3 below = has_below ? particle(texel + ivec2(0, 1)) : here;
    vec3 across = has_right && has_below ? particle(texel + ivec2(1, 1)) : here;
    vec3 left_below = texel.x > 0 && has_below ? particle(texel + ivec2(-1, 1)) : here;
    vec4 found = vec4(not_crossed);
    bool upper = false;
    bool lower = false;
    for (int k = 0; k < push.triangle_count; ++k) {
        CutterTriangle cutter = cutters[k];
        if (cutter.a.w == 0.0f) break;  // active triangles come first
        if (has_right) found.x = first_crossing(found.x, here, right, cutter);
        if (has_below) found.y = first_crossing(found.y, here, below, cutter);
        if (has_right && has_below) found.z = first_crossing(found.z, here, across, cutter);
        if (texel.x > 0 && has_below) found.w = first_crossing(found.w, here, left_below, cutter);
        if (has_right && has_below) {
            upper = upper || triangles_intersect(here, right, below, cutter.a.xyz, cutter.b.xyz, cutter.c.xyz);
            lower = lower || triangles_intersect(right, across, below, cutter.a.xyz, cutter.b.xyz, cutter.c.xyz);
        }
    }
    if (masked) {
        vec4 share = imageLoad(spring_shares, texel);
        if (share.x == 0.0f) found.x = not_crossed;
        if (share.y == 0.0f) found.y = not_crossed;
        if (share.z == 0.0f) found.z = not_crossed;
        if (share.w == 0.0f) found.w = not_crossed;
        if (has_right && has_below) {
            uint present = imageLoad(cells, texel).x;
            upper = upper && (present & 1u) != 0u;
            lower = lower && (present & 2u) != 0u;
        }
    }
    imageStore(cut_fractions, texel, found);
    if (has_right && has_below) {
        imageStore(cut_flags, ivec2(2 * texel.x, texel.y), uvec4(upper ? 1u : 0u));
        imageStore(cut_flags, ivec2(2 * texel.x + 1, texel.y), uvec4(lower ? 1u : 0u));
    }
    uint crossed = (found.x >= 0.0f ? 1u : 0u) + (found.y >= 0.0f ? 1u : 0u) + (found.z >= 0.0f ? 1u : 0u) +
                   (found.w >= 0.0f ? 1u : 0u);
    if (crossed > 0u) atomicAdd(count[0], crossed);
}
