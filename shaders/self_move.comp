// This pass cuts short every motion that would go farther than was proved to cross nothing. The velocity that a particle
// came with stays, so that what holds its motion back takes no momentum away.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;
#include "include/state_store.h"
VECTOR_OUT(7, DisplacementsOut, displacements_out);
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) readonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 5, rgba32f) uniform readonly imageBuffer before_in;
layout(set = 0, binding = 8, std430) writeonly buffer BeforeOut { vec4 before_out[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 9, rgba32f) uniform readonly imageBuffer velocities_in;
layout(set = 0, binding = 10, std430) writeonly buffer VelocitiesOut { vec4 velocities_out[]; };
layout(set = 0, binding = 11, rgba32f) uniform readonly imageBuffer made_good;
layout(set = 0, binding = 12, std430) buffer Borne { SelfBorne borne[]; };
layout(set = 0, binding = 13, rgba32f) uniform readonly imageBuffer supports;
layout(set = 0, binding = 14, rgba32f) uniform readonly imageBuffer led_ways;

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

struct Motion {
    bool held, cut, pushed, led;
    vec4 displacement;  // w: bits (self_sheet.h)
    vec3 bounded;       // displacement that contact allows, m
    float share;        // share of the motion that crosses nothing
};

Motion motion_of(int place) {
    float share = uintBitsToFloat(shares[(self_rounds - 1) * push.grid.x * push.grid.y + place]);
    ivec2 texel = texel_of(place);
    bool held = !(imageLoad(positions, texel).w > 0.0f);
    vec4 displacement = imageLoad(displacements_in, texel);
    vec4 before = imageLoad(before_in, place);
    vec3 moved = displacement.xyz;
    vec3 allowed = self_bounded(moved, before.xyz, carried, cloth_at(texel).thickness);
    vec3 bounded = held ? moved : allowed;
    bool changed = bounded.x != moved.x || bounded.y != moved.y || bounded.z != moved.z;
    bool pushed = before.w == self_pushed || before.w == self_pushed_and_led, led = before.w >= self_led_out;
    return Motion(held, owner_of(place) >= 0 && (share < 1.0f || changed), pushed, led, displacement, bounded, share);
}

bool is_changed(int place) {
    Motion motion = motion_of(place);
    return motion.cut || motion.pushed || motion.led;
}

uint unproved = 0u, truncated = 0u;
float lag = 0.0f;

vec3 velocity_of(int place, Motion motion) {
    vec3 moved = motion.displacement.xyz;
    if (motion.led) moved = self_own_motion(moved, imageLoad(led_ways, place).xyz);
    vec3 pushed = self_velocity(moved, imageLoad(velocities_in, place).xyz, imageLoad(made_good, place).xyz,
                                imageLoad(supports, 2 * place).xyz);
    return motion.pushed ? pushed : moved;
}

/// Returns how far a particle moves, and counts whether that is less than it would.
vec3 made_of(Motion motion) {
    if (!motion.cut) return motion.displacement.xyz;
    ++truncated;
    vec3 made = self_truncated(carried, self_relative_motion(motion.bounded, carried), motion.share);
    lag = self_largest(lag, self_lag(made, motion.displacement.xyz));
    return made;
}

void end(int place) {
    Motion motion = motion_of(place);
    if (motion.held) {
        unproved += motion.cut ? 1u : 0u;
    } else {
        velocities_out[place] = vec4(velocity_of(place, motion), 0.0f);
        STORE_VECTOR(displacements_out, texel_of(place), vec4(made_of(motion), motion.displacement.w));
        before_out[place].w = motion.cut || motion.pushed ? self_pushed : self_led_out;
    }
}

void count() {
    record[0].most_pairs = max(record[0].most_pairs, record[0].point_count + record[0].edge_count);
    record[0].most_near = max(record[0].most_near, record[0].near_point_count + record[0].near_edge_count);
    uint touching = record[0].touching_point_count + record[0].touching_edge_count;
    record[0].most_touching = max(record[0].most_touching, touching);
    if (touching == 0u) borne[0].corners.x = 0u;
    record[0].most_cells = max(max(record[0].most_cells, record[0].cell_count),
                               max(record[0].candidate_count, record[0].block_count));
}

void main() {
    carried = record[0].carried.xyz;
    FOR_FOUND(place, push.grid.x * push.grid.y, is_changed(place), end(place))
    if (unproved > 0u) atomicAdd(record[0].unproved, unproved);
    if (truncated > 0u) atomicAdd(record[0].truncated, truncated);
    if (lag > 0.0f) atomicMax(record[0].most_lag, floatBitsToUint(lag));
    if (gl_GlobalInvocationID.x == 0u) count();
}
