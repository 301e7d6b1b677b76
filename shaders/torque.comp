// This pass sums the torque of what a substep's steps gave to a cloth in the place of its own forces (rotation.h), with
// a record for each workgroup. It comes before contact. Where `windy`, air acts on the cloth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/rotation_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/rotation.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(RotationPush)
#define TOGETHER
#include "include/places.h"
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement_before;
layout(set = 0, binding = 3, r32ui) uniform readonly uimage2D line_control;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D torques;
layout(constant_id = 22) const bool second_order = false;
layout(constant_id = 23) const bool windy = false;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D wind_force;

#define RECORD TorqueSum
#include "include/workgroup_reduction.h"
#include "include/stored_torque.h"

vec3 start, moved;  // position and displacement of the particle `about`, m
bool is_bdf2;       // all three are read before anything has branched (docs/devices.md)

/// Returns the sum with a particle. One that is held has no mass here. Nothing branches: on the default device all
/// numbers of the sum would be blended at the end of every branch.
TorqueSum with_particle(TorqueSum sum, ivec2 texel) {
    vec4 position = LOAD(position, texel), now = LOAD(displacement, texel);
    vec3 before = LOAD(displacement_before, texel).xyz;
    vec4 force = vec4(0.0f);
    if (windy) force = LOAD(wind_force, texel);
    return joined(sum, torque_on(position, start, now, moved, before, force.xyz, windy, is_bdf2, push));
}

void main() {
    start = LOAD(position, push.about).xyz;
    moved = LOAD(displacement, push.about).xyz;
    is_bdf2 = false;
    if (second_order) is_bdf2 = imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u;
    TorqueSum sum = empty_torque();
    int group = int(gl_WorkGroupID.x), count = push.grid.x * push.grid.y;
    int place = group * torque_particles + int(gl_LocalInvocationIndex);
    int end = min((group + 1) * torque_particles, count);
    // With its test at the bottom, SwiftShader loses what lanes have summed that leave this loop before others.
    for (; place < end; place += workgroup_width) sum = with_particle(sum, texel_of(place, push.grid.x));
    sum = joined_over_workgroup(sum);
    if (gl_LocalInvocationIndex != 0u) return;
    store_sum(group, sum);
}
