// This pass starts the disturbed run: it displaces the particles by a tiny distance (include/disturb.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/closed_loop_types.h"
#include "shared/simulation_types.h"
#include "include/disturb.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(DisturbPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D disturbed_position;

vec3 at(ivec2 texel) { return LOAD(position, min(max(texel, ivec2(0)), push.grid - 1)).xyz; }

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 here = LOAD(position, texel);
    precise vec3 along = at(texel + ivec2(1, 0)) - at(texel - ivec2(1, 0));
    precise vec3 down = at(texel + ivec2(0, 1)) - at(texel - ivec2(0, 1));
    uint index = uint(texel.y * push.grid.x + texel.x);
    imageStore(disturbed_position, placed(texel),
               vec4(disturbed(here.xyz, here.w, along, down, index, push.amplitude), here.w));
}
