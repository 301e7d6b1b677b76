// This pass is the contact of bodies with each other and with all colliders that have no mass, in one workgroup:
// actions and gravity move each body, pairs are searched for places where they may touch, and one invocation finds the
// impulses there, in the order of the pairs (include/body_meet.h). body_move.comp then moves the bodies. Only what the
// kinds of the scene need is compiled.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/body_types.h"
#include "shared/collider_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/colliders.h"
#include "include/body_action.h"
#include "include/body_boxes.h"
#include "include/body_contact.h"
#include "include/body_strike.h"
#include "include/body_walk.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(BodyMovePush)
layout(constant_id = 16) const bool weighs = false;
layout(constant_id = 17) const bool acted = false;
layout(constant_id = 18) const bool has_light = false;
layout(constant_id = 19) const bool boxes_meet = false;
layout(constant_id = 20) const bool pointed = false;
layout(constant_id = 21) const bool obstacles_move = false;
layout(set = 0, binding = 0, rgba32f) uniform image2D bodies;
layout(set = 0, binding = 1, std430) readonly buffer Constants { BodyConstants body_constants[]; };
layout(set = 0, binding = 2, std430) coherent buffer Meetings { BodyMeeting body_meetings[]; };
layout(set = 0, binding = 3, std430) readonly buffer Wind { vec4 wind[]; };
layout(set = 0, binding = 4, std430) readonly buffer BodyActions { BodyAction body_actions[]; };
layout(set = 0, binding = 6, std430) readonly buffer Points { vec4 hull_points[]; };
layout(set = 0, binding = 7, std430) coherent buffer Met { MetBody met_bodies[]; };

const bool has_balls = planes_end < spheres_end;
const bool has_boxes = spheres_end < boxes_end;
const bool has_ellipsoids = boxes_end < ellipsoids_end;
const bool has_capsules = ellipsoids_end < capsules_end;
const bool has_hulls = has_meshes;

vec3 hull_point(int place) { return pointed ? hull_points[place].xyz : vec3(0.0f, 0.0f, 0.0f); }

#include "include/body_state.h"
#include "include/body_drive.h"
#include "include/body_meet.h"

void wait_for_all() {
    memoryBarrierBuffer();
    barrier();
}

void main() {
    int own = int(gl_LocalInvocationID.x), all = push.body_count + push.obstacle_count;
    for (int number = own; number < all; number += workgroup_width) {
        MetBody met;
        if (number < push.body_count)
            met = met_body(driven_body(number), body_constants[number]);
        else
            met = met_obstacle(body_constants[number]);
        met_bodies[number] = met;
    }
    wait_for_all();
    for (int pair = own; pair < push.body_count * all; pair += workgroup_width) find_meetings(pair, all);
    wait_for_all();
    if (own == 0) meet_all(all);
    wait_for_all();
    for (int number = own; number < push.body_count; number += workgroup_width) {
        store_motion(number, body_after_meetings(number, body_at(number)));
        imageStore(bodies, ivec2(body_last_velocity, number), vec4(0.0f, 0.0f, 0.0f, met_bodies[number].led.w));
    }
}
