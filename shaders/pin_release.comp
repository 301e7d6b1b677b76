// Frees particles whose pin is released: from then on w is their own inverse mass; the displacement stays, so they keep
// their velocity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { PinPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D position_out;
layout(set = 0, binding = 2, std430) readonly buffer Pins { PinnedParticle pins[]; };
layout(set = 0, binding = 3, std430) readonly buffer Motions { PinMotion motions[]; };

void main() {
    int particle = int(gl_GlobalInvocationID.x);
    if (particle >= push.particle_count) return;
    ivec4 index = pins[particle].index;
    if (motions[push.motion_first + index.z].held.x != 0.0f) return;
    vec4 position = imageLoad(position_in, index.xy);
    if (position.w == 0.0f) imageStore(position_out, index.xy, vec4(position.xyz, pins[particle].rest.w));
}
