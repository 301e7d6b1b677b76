// This pass moves the bodies that have a mass: actions and gravity, then contact with the planes, then a step of each,
// whose pose it writes over what the host put into the substep's records of colliders. Where the scene `weighs`, gravity
// changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/body_types.h"
#include "shared/collider_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/body_action.h"
#include "include/body_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(BodyMovePush)
layout(constant_id = 16) const bool weighs = false;
layout(constant_id = 17) const bool acted = false;
layout(set = 0, binding = 0, rgba32f) uniform image2D bodies;
layout(set = 0, binding = 1, std430) readonly buffer Constants { BodyConstants body_constants[]; };
layout(set = 0, binding = 2, std430) buffer Colliders { ColliderRecord colliders[]; };
layout(set = 0, binding = 3, std430) readonly buffer Wind { vec4 wind[]; };
layout(set = 0, binding = 4, std430) readonly buffer BodyActions { BodyAction body_actions[]; };

#include "include/body_state.h"
#include "include/body_step.h"

void main() {
    int number = int(gl_GlobalInvocationID.x);
    if (number >= push.body_count) return;
    BodyConstants constants = body_constants[number];
    RigidBody before = body_at(number);
    vec3 gravity = push.gravity.xyz;
    if (weighs) {
        precise vec3 changed = gravity + wind[push.weather].xyz;
        gravity = changed;
    }
    float last_step = imageLoad(bodies, ivec2(body_last_spin, number)).w;
    RigidBody pushed = before;
    if (acted)
        pushed = acted_body(before, constants, body_actions[push.first_action + number], push.begins == 1, gravity,
                            last_step, push.gravity.w);
    RigidBody fallen = fallen_body(pushed, gravity, fall_time(last_step, push.gravity.w));
    RigidBody body = body_on_planes(fallen, constants);
    RigidBody now = moved_body(body, constants.inverse.xyz, push.gravity.w);
    store_body(number, now);
    imageStore(bodies, ivec2(body_last_velocity, number), vec4(now.velocity, touches_planes(fallen, body)));
    imageStore(bodies, ivec2(body_last_spin, number), vec4(now.spin, push.gravity.w));
    for (int list = 0; list < push.list_count; ++list) {
        int place = push.first + list * push.record_count + constants.what.y;
        colliders[place] = placed_record(colliders[place], constants, before, now);
    }
}
