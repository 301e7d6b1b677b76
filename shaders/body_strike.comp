// This pass gives the bodies that have a mass the opposite of what they gave to a cloth's motion in the substep: of the
// cloth's sums, less those of the substeps before. To a light one it is owed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/body_types.h"
#include "shared/impulse_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/impulses.h"
#include "include/rigid_body.h"
#include "include/body_strike.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(BodyStrikePush)
layout(constant_id = 16) const bool has_light = false;
layout(set = 0, binding = 0, rgba32f) uniform image2D bodies;
layout(set = 0, binding = 1, std430) readonly buffer Constants { BodyConstants body_constants[]; };
layout(set = 0, binding = 2, r32ui) uniform readonly uimage2D impulses;
layout(set = 0, binding = 3, r32ui) uniform uimage2D struck;

#include "include/body_state.h"

/// Returns what has been added to a number of a body's row since the last substep.
float added(int number, int row, int column) {
    ivec2 place = ivec2(2 * column, row), kept = ivec2(2 * column, number);
    ImpulseWords now = ImpulseWords(imageLoad(impulses, place).x, imageLoad(impulses, place + ivec2(1, 0)).x);
    ImpulseWords before = ImpulseWords(0u, 0u);
    if (push.begins == 0)
        before = ImpulseWords(imageLoad(struck, kept).x, imageLoad(struck, kept + ivec2(1, 0)).x);
    imageStore(struck, kept, uvec4(now.low, 0u, 0u, 0u));
    imageStore(struck, kept + ivec2(1, 0), uvec4(now.high, 0u, 0u, 0u));
    return words_number(words_difference(now, before));
}

vec3 added_vector(int number, int row, int first) {
    return vec3(added(number, row, first), added(number, row, first + 1), added(number, row, first + 2));
}

void main() {
    int number = int(gl_GlobalInvocationID.x);
    if (number >= push.body_count) return;
    BodyConstants constants = body_constants[number];
    int row = impulse_first + constants.what.y;
    vec3 given = added_vector(number, row, 0), moment = added_vector(number, row, 3);
    RigidBody body = body_at(number);
    BodyStrike strike = strike_of(body, constants, given, moment, push.unit);
    if (has_light) {
        if (is_light(constants)) {
            vec4 owed = imageLoad(bodies, ivec2(body_owed, number));
            BodyStrike all =
                strikes_sum(BodyStrike(owed.xyz, imageLoad(bodies, ivec2(body_owed_spin, number)).xyz), strike);
            imageStore(bodies, ivec2(body_owed, number), vec4(all.impulse, is_strike(strike) ? 1.0f : owed.w));
            imageStore(bodies, ivec2(body_owed_spin, number), vec4(all.moment, 0.0f));
            return;
        }
    }
    store_body(number, struck_body(body, constants.inverse.w, strike.impulse, strike.moment));
}
