// Cuts the motions short that would go farther than was proved to cross nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants HISTORY BUFFERED
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
#include "include/self_touch.h"
layout(set = 0, binding = 5, std430) readonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 6, std430) readonly buffer Before { vec4 before[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    int index = texel.y * push.grid.x + texel.x;
    if (index == 0) {
        record[0].most_pairs = max(record[0].most_pairs, record[0].pair_count);
        record[0].most_cells = max(max(record[0].most_cells, record[0].cell_count),
                                   max(record[0].candidate_count, record[0].block_count));
    }
    float share = uintBitsToFloat(shares[(self_rounds - 1) * push.grid.x * push.grid.y + index]);
    bool held = !(imageLoad(position, texel).w > 0.0f);
    vec4 displacement = imageLoad(displacement_in, texel);
    vec3 carried = record[0].carried.xyz;
    vec3 first = before[index].xyz;
    bool cut = share < 1.0f || (!held && self_exceeds(displacement.xyz, first, push.thickness));
    vec3 bounded = held ? displacement.xyz : self_bounded(displacement.xyz, first, push.thickness);
    vec3 moved = self_relative_motion(bounded, carried);
    precise vec3 part = moved * share;
    vec3 made = held ? moved : part;
    uint motion = floatBitsToUint(self_motion(made));
    // Most that come here find one that moved farther.
    for (int go = motion > record[0].moved ? 1 : 0; go > 0; --go) atomicMax(record[0].moved, motion);
    for (int go = cut ? 1 : 0; go > 0; --go) {
        if (held) {
            atomicAdd(record[0].unproved, 1u);
        } else {
            atomicAdd(record[0].truncated, 1u);
            touch(texel, displacement, self_truncated(carried, moved, share));
        }
    }
}
