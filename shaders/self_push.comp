// Moves the particles by what the pairs push them, and keeps what they were to do before it.
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
layout(set = 0, binding = 5, std430) buffer Corrections { ivec4 corrections[]; };
layout(set = 0, binding = 6, std430) buffer Before { vec4 before[]; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    int index = texel.y * push.grid.x + texel.x;
    vec4 moved = imageLoad(displacement_in, texel);
    for (int go = push.round == 0 ? 1 : 0; go > 0; --go) before[index] = moved;
    ivec4 sum = corrections[index];
    if (sum.w == 0 || !(imageLoad(position, texel).w > 0.0f)) return;
    corrections[index] = ivec4(0, 0, 0, 0);
    vec3 corrected = self_corrected(moved.xyz, sum, push.thickness);
    touch(texel, moved, self_bounded(corrected, before[index].xyz, push.thickness));
}
