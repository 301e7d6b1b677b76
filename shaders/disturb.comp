// This pass displaces the particles of a run by next to nothing (include/disturb.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/closed_loop_types.h"
#include "shared/simulation_types.h"
#include "include/disturb.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(DisturbPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform image2D position;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 at = LOAD(position, texel);
    uint index = uint(texel.y * push.grid.x + texel.x);
    imageStore(position, placed(texel), vec4(disturbed(at.xyz, at.w, index, push.amplitude), at.w));
}
