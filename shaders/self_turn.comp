// This pass gives a cloth back what contact between cloths has made of its angular momentum (self_couples.comp), by a
// turn that changes velocities alone: particles are where contact let them be, so the remainder of their position takes
// back by what it moves them, which may be less than a position shows. The pass also turns the motions of the substep
// before where that `ends_frame`, since what is given back is no acceleration.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/rotation_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/rotation.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(ContactTurnPush)
#define TOGETHER
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position_remainder_in;
VECTOR_OUT(2, position_remainder_out);
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(4, displacement_out);
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D positions;  // on the sheet, where the substep started
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D torques;
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D paid_in;
layout(set = 0, binding = 8, rgba32f) uniform writeonly image2D paid_out;
layout(constant_id = 0) const bool advance = false;  // not the frame's first substep
layout(constant_id = 24) const bool ends_frame = false;
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D displacement_before_in;
VECTOR_OUT(10, displacement_before_out);

#include "include/joined_torques.h"

vec3 start;  // where the particle `about` started, m
Rotation rotation;

void turn(ivec2 texel) {
    vec4 own = LOAD(position, texel), moved = LOAD(displacement_in, texel);
    if (own.w == 0.0f) return;
    vec3 by = turned_by(rotation, arm_at_end(own.xyz, moved.xyz, start));
    vec3 lost = LOAD(position_remainder_in, texel).xyz;
    STORE_VECTOR(position_remainder_out, texel, vec4(without_turn(lost, by), 0.0f));
    STORE_TRIPLE(displacement_out, texel, with_turn(moved.xyz, by), moved.w);
    if (!ends_frame) return;
    vec4 before = LOAD(displacement_before_in, texel);
    STORE_VECTOR(displacement_before_out, texel, vec4(with_turn(before.xyz, by), before.w));
}

void main() {
    vec4 about = imageLoad(positions, push.first + push.about);
    start = about.xyz;
    vec3 paid = vec3(0.0f);
    if (advance) paid = imageLoad(paid_in, ivec2(push.paid, cloth_place())).xyz;
    TorqueSum sum = joined_sums();
    bool held = about.w == 0.0f;
    rotation = rotation_of(contact_owed(sum, paid, ends_frame), push.axis, held);
    if (gl_GlobalInvocationID.xy == uvec2(0u) && !ends_frame) {
        Rotation ahead = rotation_of(contact_advance(sum), push.axis, held);
        imageStore(paid_out, ivec2(1 - push.paid, cloth_place()), vec4(sum.torque.xyz, 0.0f));
        imageStore(paid_out, ivec2(paid_turn, cloth_place()), vec4(ahead.turn, 0.0f));
        imageStore(paid_out, ivec2(paid_turn + 1, cloth_place()), vec4(turned_about(ahead, start), 0.0f));
    }
    if (rotation.turn == vec3(0.0f)) return;  // nothing touches
    FOR_STRIP(texel, push.grid, turn(texel))
}
