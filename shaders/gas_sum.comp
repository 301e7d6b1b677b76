// This pass sums over a cloth that closes gas in what its volume follows from (GasSum), with a record for each
// workgroup. The image of the air's force has the areas of places.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/gas_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/gas.h"
#include "include/places.h"
#include "include/together.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GasSumPush)
layout(constant_id = 0) const bool lags = false;  // the positions lack the last substep's displacement
layout(constant_id = 22) const bool second_order = false;
layout(constant_id = 24) const bool supported = false;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement_before;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D velocity_excess;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D wind_force;
layout(set = 0, binding = 5, std430) readonly buffer GasShares { vec2 gas_shares[]; };
layout(set = 0, binding = 6, std430) writeonly buffer GasSums { GasSum gas_sums[]; };
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D displacement_remainder;  // w: a collider touches it

#define RECORD GasSum
#include "include/workgroup_reduction.h"

vec3 origin;

vec3 place_now(vec3 start, vec3 moved) {
    precise vec3 now = start;
    if (lags) now = now + moved;
    return now;
}

GasSum with_particle(GasSum sum, int place) {
    ivec2 texel = texel_of(place, push.grid.x);
    vec4 start = LOAD(position, texel);
    vec3 moved = LOAD(displacement, texel).xyz, inertia = moved;
    if (second_order)
        inertia = gas_inertia(moved, LOAD(displacement_before, texel).xyz, LOAD(velocity_excess, texel).xyz);
    bool held = start.w == 0.0f, touched = false;
    if (supported) touched = LOAD(displacement_remainder, texel).w != 0.0f;
    precise vec3 arm = place_now(start.xyz, moved) - origin;
    return joined(sum, gas_term(LOAD(wind_force, texel).xyz, gas_shares[place], held, touched, arm, moved, inertia));
}

void main() {
    ivec2 from = texel_of(push.origin, push.grid.x);
    origin = place_now(LOAD(position, from).xyz, LOAD(displacement, from).xyz);
    GasSum sum = empty_gas_sum();
    int group = int(gl_WorkGroupID.x), count = push.grid.x * push.grid.y;
    int place = group * gas_particles + int(gl_LocalInvocationIndex);
    int end = min((group + 1) * gas_particles, count);
    // A test at the bottom would lose sums on a driver, as in torque.comp (docs/devices.md).
    for (; place < end; place += workgroup_width) sum = with_particle(sum, place);
    sum = joined_over_workgroup(sum);
    if (gl_LocalInvocationIndex != 0u) return;
    sum.origin.xyz = origin;
    gas_sums[push.first + group] = sum;
}
