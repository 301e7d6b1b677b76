// This pass sums, after contact between cloths, what that has made of a cloth's angular momentum (rotation.h), with a
// record for each workgroup: a pair's impulse acts on its two sides at either one's nearest point, so that friction has
// a couple, and a motion that was cut short is no motion by the velocity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/rotation_types.h"
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/rotation.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(ContactTurnPush)
#define TOGETHER
#include "include/places.h"
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D positions;  // on the sheet, where the substep started
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D torques;
layout(set = 0, binding = 4, std430) readonly buffer Record { SelfRecord record[]; };
#define SUMS_IN_SLOT 5
#define SUMS_SHEET push.sheet
#include "include/self_sums.h"

#define RECORD TorqueSum
#include "include/workgroup_reduction.h"
#include "include/stored_torque.h"

vec3 start;     // where the particle `about` started, m
bool touching;  // some pairs touch; otherwise the sums belong to an earlier substep

/// Returns the sum with a particle. Nothing branches (torque.comp).
TorqueSum with_particle(TorqueSum sum, ivec2 texel) {
    ivec2 laid = push.first + texel;
    vec4 now = LOAD(position, texel);
    vec3 moved = LOAD(displacement, texel).xyz, at_start = imageLoad(positions, laid).xyz;
    vec3 halves = impulse_of(sum_of(self_sum_of_couples, laid.y * push.sheet.x + laid.x), push.largest);
    vec3 couple = self_couple_of(halves, push.largest, push.lightness);
    couple = touching ? couple : vec3(0.0f);
    return joined(sum, contact_torque_on(arm_at_end(now.xyz, moved, start), now.w, way_between(at_start, now.xyz), moved,
                                         couple));
}

void main() {
    start = imageLoad(positions, push.first + push.about).xyz;
    touching = record[0].touching_point_count + record[0].touching_edge_count > 0u;
    TorqueSum sum = empty_torque();
    int group = int(gl_WorkGroupID.x), count = push.grid.x * push.grid.y;
    int place = group * torque_particles + int(gl_LocalInvocationIndex);
    int end = min((group + 1) * torque_particles, count);
    // Its test is at the top as in torque.comp.
    for (; place < end; place += workgroup_width) sum = with_particle(sum, texel_of(place, push.grid.x));
    sum = joined_over_workgroup(sum);
    if (gl_LocalInvocationIndex != 0u) return;
    store_sum(group, sum);
}
