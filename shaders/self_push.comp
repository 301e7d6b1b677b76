// Moves the particles by what the pairs push them, and notes how far each may go in the substep.
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
layout(set = 0, binding = 5, std430) readonly buffer Corrections { ivec4 corrections[]; };
layout(set = 0, binding = 6, std430) writeonly buffer Limits { float limits[]; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    int index = texel.y * push.grid.x + texel.x;
    vec4 moved = imageLoad(displacement_in, texel);
    limits[index] = self_limit(moved.xyz, push.thickness);
    ivec4 sum = corrections[index];
    if (sum.w == 0 || !(imageLoad(position, texel).w > 0.0f)) return;
    touch(texel, moved, self_corrected(moved.xyz, sum, push.thickness));
}
