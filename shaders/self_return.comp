// This pass ends a substep's contact for a cloth. It cuts short every motion that would go farther than was proved to
// cross nothing. The particle's velocity remains its displacement, and its start is shifted so that it ends where
// contact allows: what held it back, or led it apart, is no velocity. In `second_order` the cloth continues in backward
// Euler substeps (include/bdf2.h). There, and in a frame's last substep of other methods, the displacement of the
// substep before is changed in the same way as contact changed this one's, so that the two give the same acceleration
// by springs as without contact.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(SelfClothPush)
#define TOGETHER
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(1, displacement_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacements;   // on the sheet
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer before;      // w: what moved the particle
layout(set = 0, binding = 4, rgba32f) uniform readonly imageBuffer velocities;  // of these particles
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D position_in;
TRIPLE_OUT(6, position_out);
layout(constant_id = 22) const bool second_order = false;
layout(constant_id = 24) const bool ends_frame = false;
const bool changes_before = second_order || ends_frame;
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D displacement_before_in;
TRIPLE_OUT(9, displacement_before_out);
layout(set = 0, binding = 8, r32ui) uniform uimage2D line_control;
layout(set = 0, binding = 10, std430) readonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 11, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 12, rgba32f) uniform readonly imageBuffer made_good;
layout(set = 0, binding = 13, std430) writeonly buffer Borne { SelfBorne borne[]; };
layout(set = 0, binding = 14, rgba32f) uniform readonly imageBuffer supports;
layout(set = 0, binding = 15, rgba32f) uniform readonly imageBuffer led_ways;

vec3 carried;  // the member's, read before anything has branched (docs/devices.md)

struct Motion {
    bool held, cut, pushed, led;
    vec3 wanted, moved, bounded;  // displacement before contact, after it, and what contact allows of it, m
    float share;                  // share of the motion that crosses nothing
};

int place_of(ivec2 texel) { return (push.first.y + texel.y) * push.sheet.x + push.first.x + texel.x; }

Motion motion_of(ivec2 texel) {
    int place = place_of(texel);
    float share = uintBitsToFloat(shares[(self_rounds - 1) * push.sheet.x * push.sheet.y + place]);
    bool held = !(LOAD(position_in, texel).w > 0.0f);
    vec3 moved = imageLoad(displacements, push.first + texel).xyz;
    vec4 was = imageLoad(before, place);
    vec3 allowed = self_bounded(moved, was.xyz, carried, push.thickness);
    vec3 bounded = held ? moved : allowed;
    bool changed = bounded.x != moved.x || bounded.y != moved.y || bounded.z != moved.z;
    bool pushed = was.w == self_pushed || was.w == self_pushed_and_led, led = was.w >= self_led_out;
    return Motion(held, share < 1.0f || changed, pushed, led, was.xyz, moved, bounded, share);
}

bool is_changed(ivec2 texel) {
    Motion motion = motion_of(texel);
    return motion.cut || motion.pushed || motion.led;
}

uint unproved = 0u, truncated = 0u;
float lag = 0.0f;

vec3 velocity_of(int place, Motion motion) {
    vec3 own = motion.led ? self_own_motion(motion.moved, imageLoad(led_ways, place).xyz) : motion.moved;
    vec3 pushed = self_velocity(own, imageLoad(velocities, place).xyz, imageLoad(made_good, place).xyz,
                                imageLoad(supports, 2 * place).xyz);
    return motion.pushed ? pushed : own;
}

/// Returns how far a particle moves, and counts it if that is less than it would.
vec3 made_of(Motion motion) {
    if (!motion.cut) return motion.moved;
    ++truncated;
    vec3 made = self_truncated(carried, self_relative_motion(motion.bounded, carried), motion.share);
    lag = self_largest(lag, self_lag(made, motion.moved));
    return made;
}

/// Makes the cloth continue in backward Euler substeps. Reading first avoids an atomic, since most particles that come
/// here find the hold set.
void hold_order() {
    if (imageLoad(line_control, ivec2(control_hold, cloth_place())).x < line_hold_contact)
        imageAtomicMax(line_control, ivec2(control_hold, cloth_place()), line_hold_contact);
}

void end_motion(ivec2 texel) {
    Motion motion = motion_of(texel);
    if (motion.held) {
        unproved += motion.cut ? 1u : 0u;
        return;
    }
    vec3 made = made_of(motion), velocity = velocity_of(place_of(texel), motion);
    vec4 start = LOAD(position_in, texel);
    STORE_TRIPLE(position_out, texel, self_start(start.xyz, made, velocity), start.w);
    STORE_TRIPLE(displacement_out, texel, velocity, LOAD(displacement_in, texel).w);
    if (changes_before) {
        vec3 last = LOAD(displacement_before_in, texel).xyz;
        if (motion.cut || motion.pushed)
            STORE_TRIPLE(displacement_before_out, texel, self_changed_alike(last, motion.wanted, velocity), 0.0f);
    }
    if (second_order) hold_order();
}

void end_all() { FOR_STRIP_FOUND(texel, push.grid, is_changed(texel), end_motion(texel)) }

/// Records in the frame's counts how many entries the substep's lists had.
void count_lists() {
    record[0].most_pairs = max(record[0].most_pairs, record[0].point_count + record[0].edge_count);
    record[0].most_near = max(record[0].most_near, record[0].near_point_count + record[0].near_edge_count);
    uint touching = record[0].touching_point_count + record[0].touching_edge_count;
    record[0].most_touching = max(record[0].most_touching, touching);
    if (touching == 0u) borne[0].corners.x = 0u;
    record[0].most_cells = max(max(record[0].most_cells, record[0].cell_count),
                               max(record[0].candidate_count, record[0].block_count));
}

void count_own(int member) {
    record[member].most_own_pairs = max(record[member].most_own_pairs, record[member].own_pairs);
}

void main() {
    carried = record[push.member].carried.xyz;
    end_all();
    if (unproved > 0u) atomicAdd(record[push.member].unproved, unproved);
    if (truncated > 0u) atomicAdd(record[push.member].truncated, truncated);
    if (lag > 0.0f) atomicMax(record[push.member].most_lag, floatBitsToUint(lag));
    if (push.cloth_count == 0 || gl_GlobalInvocationID.xy != uvec2(0u)) return;
    if (push.member == 0) count_lists();
    if (push.member_count > 1) count_own(push.member);
}
