// This pass turns a cloth so that it keeps its angular momentum (rotation.h). Every workgroup joins the sums that
// torque.comp left: lane l takes every 64th from the l-th on, then a tree joins the lanes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/rotation_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/rotation.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;  // not the frame's first substep
CLOTH_CONSTANTS(RotationPush)
#define TOGETHER
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(2, displacement_out);
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D torques;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D angular_error_in;
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D angular_error_out;

#include "include/joined_torques.h"

vec3 start;  // position of the particle `about`, m
Rotation rotation;

void rotate(ivec2 texel) {
    vec4 position = LOAD(position, texel), moved = LOAD(displacement_in, texel);
    precise vec3 arm = position.xyz - start;
    vec3 displacement = rotated(rotation, arm, moved.xyz);
    STORE_TRIPLE(displacement_out, texel, position.w == 0.0f ? moved.xyz : displacement, moved.w);
}

void main() {
    vec4 about = LOAD(position, push.about);
    start = about.xyz;
    rotation = rotation_of(joined_sums(), push.axis, about.w == 0.0f);
    if (gl_GlobalInvocationID.xy == uvec2(0u)) {
        ivec2 own = ivec2(0, cloth_place());
        vec3 before = vec3(-0.0f);  // the sum of nothing
        if (advance) before = imageLoad(angular_error_in, own).xyz;
        precise vec3 taken = before + rotation.taken;
        imageStore(angular_error_out, own, vec4(taken, 0.0f));
    }
    FOR_STRIP(texel, push.grid, rotate(texel))
}
