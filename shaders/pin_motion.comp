// This pass moves held particles along their key-framed motion: d = target - X, so that X + d is the target itself.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/vector.h"
#include "include/pin.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(PinPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D displacement;
layout(set = 0, binding = 2, std430) readonly buffer PinnedParticles { PinnedParticle pinned_particles[]; };
layout(set = 0, binding = 3, std430) readonly buffer PinMotions { PinMotion pin_motions[]; };

void main() {
    int particle = int(gl_GlobalInvocationID.x);
    if (particle >= push.particle_count) return;
    ivec4 index = pinned_particles[particle].index;
    if (!is_present(uint(index.w / push.rows))) return;
    PinMotion motion = pin_motions[push.motion_first + index.z];
    if (motion.held.x == 0.0f || !is_pinned(motion, ivec2(index.x, index.y - index.w))) return;
    vec3 moved = pin_displacement(motion, pinned_particles[particle].rest.xyz, imageLoad(position, index.xy).xyz);
    imageStore(displacement, index.xy, vec4(moved, 0.0f));
}
