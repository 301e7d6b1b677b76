// This pass ends a substep's contact for a cloth. It cuts short every motion that would go farther than was proved to
// cross nothing. The particle's velocity remains its displacement, and its start is shifted so that it ends where
// contact allows: what held it back, or led it apart, is no velocity. In `second_order` the cloth continues in backward
// Euler substeps (include/bdf2.h). In the substep that `ends_frame`, the displacement of the one before becomes what
// contact would have left of it: the two differ by forces, those of contact included, and not by an impact. For a
// particle that a collider touches it becomes the velocity.
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
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D last_motions;  // on the sheet
VECTOR_KEPT(9, displacement_before);
layout(set = 0, binding = 8, r32ui) uniform uimage2D line_control;
layout(set = 0, binding = 10, std430) readonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 11, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 12, rgba32f) uniform readonly imageBuffer made_good;
layout(set = 0, binding = 13, std430) writeonly buffer Borne { SelfBorne borne[]; };
layout(set = 0, binding = 14, rgba32f) uniform readonly imageBuffer supports;
layout(set = 0, binding = 15, rgba32f) uniform readonly imageBuffer led_ways;
layout(set = 0, binding = 17, std430) readonly buffer ClothShares { uint cloth_shares[]; };
#include "include/self_sewn.h"

// These are the member's, and whether the cloth goes on as a whole and its share then; all are read before anything has
// branched (docs/devices.md).
vec3 carried;
bool whole;
float least;

struct Motion {
    bool held, cut, pushed, led;
    vec3 moved, bounded;  // displacement after contact, and what contact allows of it, m
    float share;                  // share of the motion that crosses nothing
};

int place_of(ivec2 texel) { return (push.first.y + texel.y) * push.sheet.x + push.first.x + texel.x; }

Motion motion_of(ivec2 texel) {
    int place = place_of(texel);
    float share = uintBitsToFloat(shares[(self_rounds - 1) * push.sheet.x * push.sheet.y + leader_of(place)]);
    bool held = !(LOAD(position_in, texel).w > 0.0f);
    vec3 moved = imageLoad(displacements, push.first + texel).xyz;
    vec4 was = imageLoad(before, place);
    vec3 allowed = self_bounded(moved, was.xyz, carried, own_thickness(place, push.thickness));
    vec3 bounded = held ? moved : allowed;
    share = whole && !held ? least : share;
    bool changed = bounded.x != moved.x || bounded.y != moved.y || bounded.z != moved.z;
    bool pushed = was.w == self_pushed || was.w == self_pushed_and_led, led = was.w >= self_led_out;
    return Motion(held, share < 1.0f || changed, pushed, led, moved, bounded, share);
}

bool is_changed(Motion motion) { return motion.cut || motion.pushed || motion.led; }

/// Returns whether a particle lies on a collider where a frame ends with its velocity.
bool ends_lying(ivec2 texel) {
    if (!ends_frame) return false;
    vec4 plane = imageLoad(supports, 2 * place_of(texel));
    return plane.x != 0.0f || plane.y != 0.0f || plane.z != 0.0f;
}

bool concerns(ivec2 texel) { return is_changed(motion_of(texel)) || ends_lying(texel); }

uint unproved = 0u, truncated = 0u;
float lag = 0.0f;

vec3 own_of(int place, Motion motion) {
    return motion.led ? self_own_motion(motion.moved, imageLoad(led_ways, place).xyz) : motion.moved;
}

vec3 velocity_of(int place, Motion motion) {
    vec3 own = own_of(place, motion);
    vec3 pushed = self_velocity(own, imageLoad(velocities, place).xyz, imageLoad(made_good, place).xyz,
                                imageLoad(supports, 2 * place).xyz);
    return motion.pushed ? pushed : own;
}

/// Returns the motion of the substep before as contact and colliders would have left it.
vec3 last_motion(ivec2 texel, Motion motion, vec3 velocity) {
    int place = place_of(texel);
    vec3 own = own_of(place, motion);
    bool touched = self_was_touched(own, imageLoad(velocities, place).xyz, imageLoad(made_good, place).xyz,
                                    imageLoad(supports, 2 * place).xyz);
    return touched ? velocity : imageLoad(last_motions, push.first + texel).xyz;
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
    if (!is_changed(motion)) {
        STORE_VECTOR(displacement_before, texel, vec4(motion.moved, 0.0f));
        return;
    }
    vec3 made = made_of(motion), velocity = velocity_of(place_of(texel), motion);
    vec4 start = LOAD(position_in, texel);
    STORE_TRIPLE(position_out, texel, self_start(start.xyz, made, velocity), start.w);
    STORE_TRIPLE(displacement_out, texel, velocity, LOAD(displacement_in, texel).w);
    if (ends_frame && (motion.pushed || ends_lying(texel)))
        STORE_VECTOR(displacement_before, texel, vec4(last_motion(texel, motion, velocity), 0.0f));
    if (second_order) hold_order();
}

void end_all() { FOR_STRIP_FOUND(texel, push.grid, concerns(texel), end_motion(texel)) }

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
    int own = push.body * self_cloth_words;
    whole = cloth_shares[own] != 0u;
    least = uintBitsToFloat(cloth_shares[own + self_rounds]);
    end_all();
    if (unproved > 0u) atomicAdd(record[push.member].unproved, unproved);
    if (truncated > 0u) atomicAdd(record[push.member].truncated, truncated);
    if (lag > 0.0f) atomicMax(record[push.member].most_lag, floatBitsToUint(lag));
    if (push.cloth_count == 0 || gl_GlobalInvocationID.xy != uvec2(0u)) return;
    if (push.member == 0) count_lists();
    if (push.member_count > 1) count_own(push.member);
}
