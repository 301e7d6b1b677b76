// Cuts the displacements short that would go farther than was proved to cross nothing.
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
layout(set = 0, binding = 6, std430) readonly buffer Limits { float limits[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    int index = texel.y * push.grid.x + texel.x;
    if (index == 0 && record[0].pair_count > record[0].most_pairs) record[0].most_pairs = record[0].pair_count;
    float share = uintBitsToFloat(shares[index]);
    if (!(imageLoad(position, texel).w > 0.0f)) return;
    vec4 moved = imageLoad(displacement_in, texel);
    if (!(share < 1.0f) && !self_exceeds(moved.xyz, limits[index])) return;
    atomicAdd(record[0].truncated, 1u);
    touch(texel, moved, self_truncated(self_bounded(moved.xyz, limits[index]), share));
}
