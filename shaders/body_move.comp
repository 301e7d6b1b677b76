// This pass moves the bodies that have a mass: actions and gravity, then contact with the planes, where the bodies do
// not meet other things (body_meet.comp), then a step of each, whose pose it writes over what the host put into the
// substep's records of colliders. Where the scene `weighs`, gravity changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/body_types.h"
#include "shared/collider_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/body_action.h"
#include "include/body_contact.h"
#include "include/body_strike.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(BodyMovePush)
layout(constant_id = 16) const bool weighs = false;
layout(constant_id = 17) const bool acted = false;
layout(constant_id = 18) const bool meets = false;
layout(constant_id = 19) const bool has_light = false;
layout(set = 0, binding = 0, rgba32f) uniform image2D bodies;
layout(set = 0, binding = 1, std430) readonly buffer Constants { BodyConstants body_constants[]; };
layout(set = 0, binding = 2, std430) buffer Colliders { ColliderRecord colliders[]; };
layout(set = 0, binding = 3, std430) readonly buffer Wind { vec4 wind[]; };
layout(set = 0, binding = 4, std430) readonly buffer BodyActions { BodyAction body_actions[]; };

#include "include/body_state.h"
#include "include/body_drive.h"
#include "include/body_step.h"

void main() {
    int number = int(gl_GlobalInvocationID.x);
    if (number >= push.body_count) return;
    BodyConstants constants = body_constants[number];
    RigidBody before = body_at(number), body = before;
    float touched = 0.0f;
    if (meets) {
        touched = imageLoad(bodies, ivec2(body_last_velocity, number)).w;
    } else {
        RigidBody driven = driven_body(number);
        body = body_on_planes(driven, constants);
        touched = touches_planes(driven, body);
    }
    RigidBody now = moved_body(body, constants.inverse.xyz, push.gravity.w);
    store_body(number, now);
    imageStore(bodies, ivec2(body_last_velocity, number), vec4(now.velocity, touched));
    imageStore(bodies, ivec2(body_last_spin, number), vec4(now.spin, push.gravity.w));
    for (int list = 0; list < push.list_count; ++list) {
        int place = push.first + list * push.record_count + constants.what.y;
        colliders[place] = placed_record(colliders[place], constants, before, now);
    }
}
