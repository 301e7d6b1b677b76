// This pass makes particles that are one alike again for contact between cloths, where each cloth has met colliders by
// itself: all lie on the surface on which the first of them lies that does. With `after_impulses` all make the motion of
// the one that colliders have led farthest from where impulses had left it. An invocation takes a leader and those that
// follow it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/places.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacements_in;  // on the sheet
VECTOR_OUT(1, displacements_out);
layout(constant_id = 26) const bool after_impulses = false;
layout(set = 0, binding = 2, std430) buffer Supports { vec4 supports[]; };
layout(set = 0, binding = 3, std430) buffer Before { vec4 before[]; };
layout(set = 0, binding = 4, std430) readonly buffer Velocities { vec4 velocities[]; };
layout(set = 0, binding = 5, std430) readonly buffer MadeGood { vec4 made_good[]; };
layout(set = 0, binding = 6, std430) buffer LedWays { vec4 led_ways[]; };
layout(set = 0, binding = 7, std430) readonly buffer SewnLeaders { int sewn_leaders[]; };
#include "include/self_sewn.h"

vec4 motion_at(int place) { return imageLoad(displacements_in, texel_of(place, push.grid.x)); }

bool lies(int place) {
    vec4 plane = supports[2 * place];
    return plane.x != 0.0f || plane.y != 0.0f || plane.z != 0.0f;
}

void share_surface(int leader) {
    int lying = leader;
    for (int place = leader; place >= 0; place = sewn_corners[place].next) {
        if (lies(lying)) break;
        lying = place;
    }
    if (!lies(lying)) return;
    vec4 plane = supports[2 * lying], grip = supports[2 * lying + 1];
    for (int place = leader; place >= 0; place = sewn_corners[place].next) {
        supports[2 * place] = plane;
        supports[2 * place + 1] = grip;
    }
}

/// Returns the square of the way by which colliders have led a particle.
float led_by_colliders(int place) {
    vec4 was = before[place];
    bool pushed = was.w == self_pushed || was.w == self_pushed_and_led;
    vec3 left = was.xyz;
    if (pushed) left = self_added(velocities[place].xyz, made_good[place].xyz);
    vec3 way = self_own_motion(motion_at(place).xyz, left);
    return self_squared(way);
}

void share_motion(int leader) {
    int farthest = leader;
    float most = led_by_colliders(leader);
    for (int place = sewn_corners[leader].next; place >= 0; place = sewn_corners[place].next) {
        float way = led_by_colliders(place);
        if (way > most) farthest = place;
        most = way > most ? way : most;
    }
    vec3 motion = motion_at(farthest).xyz;
    vec4 led = led_ways[farthest];
    float by = before[farthest].w;
    // The others' cloths do not have this motion yet.
    bool changed = most > 0.0f && by == 0.0f;
    led = changed ? vec4(0.0f) : led;
    by = changed ? self_led_out : by;
    for (int place = leader; place >= 0; place = sewn_corners[place].next) {
        ivec2 texel = texel_of(place, push.grid.x);
        STORE_VECTOR(displacements_out, texel, vec4(motion, motion_at(place).w));
        led_ways[place] = led;
        before[place].w = by;
    }
}

void main() {
    int own = int(gl_GlobalInvocationID.x);
    if (own >= push.sewn_count) return;
    int leader = sewn_leaders[own];
    if (after_impulses)
        share_motion(leader);
    else
        share_surface(leader);
}
