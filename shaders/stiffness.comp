// This pass scales the spring shares of a cloth whose stiffness changes, for a frame, with an invocation per particle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(StiffnessPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D whole_spring_shares;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D spring_shares;
layout(set = 0, binding = 2, std430) readonly buffer Stiffness { float stiffness[]; };  // the factor of each cloth

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    precise vec4 acting = imageLoad(whole_spring_shares, texel) * stiffness[push.cloth];
    imageStore(spring_shares, texel, acting);
}
