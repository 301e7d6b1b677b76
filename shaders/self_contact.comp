// This pass adds up the corrections by which the listed pairs push their corners, in integers, so that the order does
// not matter. The passes after it run only where something was pushed.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants WIDE
#ifdef WIDE  // two sums share an atomic of 64 bits, which halves the atomics that most of the pass consists of
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 5, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 6, std430) buffer Corrections {
#ifdef WIDE
    u64vec2 corrections[];
#else
    ivec4 corrections[];
#endif
};
layout(set = 0, binding = 7, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"

bool pushes = false;

#ifdef WIDE
/// Returns two addends in one, the second in the upper half. The sign of the first is carried into that, which
/// self_sums takes back.
uint64_t both(int lower, int upper) { return uint64_t(int64_t(lower)) + (uint64_t(uint(upper)) << 32); }
void add_units(int place, int x, int y, int z, int weight) {
    atomicAdd(corrections[place].x, both(x, y));
    atomicAdd(corrections[place].y, both(z, weight));
}
#else
void add_units(int place, int x, int y, int z, int weight) {
    atomicAdd(corrections[place].x, x);
    atomicAdd(corrections[place].y, y);
    atomicAdd(corrections[place].z, z);
    atomicAdd(corrections[place].w, weight);
}
#endif

/// Adds an impulse's correction to those of a corner.
void add(ivec2 texel, float thickness, vec3 impulse, float mass, float weight) {
    int place = place_of(texel);
    precise float moves = mass * weight;
    precise float per_metre = self_correction_units / thickness;
    precise vec3 correction = impulse * moves;
    if (weight != 0.0f)
        add_units(place, self_units(correction.x, per_metre), self_units(correction.y, per_metre),
                  self_units(correction.z, per_metre), self_weight(weight));
}

vec3 moved(ivec2 texel) { return imageLoad(displacements, texel).xyz; }

void push_apart(bool edges, uvec4 pair) {
    ivec2 a = self_texel(pair.x), b = self_texel(pair.y), c = self_texel(pair.z), d = self_texel(pair.w);
    SelfCloth one = cloth_at(a), other = cloth_at(d);
    vec4 xa = imageLoad(positions, a), xb = imageLoad(positions, b), xc = imageLoad(positions, c),
         xd = imageLoad(positions, d);
    SelfGap gap = self_gap(edges, SelfCorners(xa.xyz, xb.xyz, xc.xyz, xd.xyz));
    vec4 mass = self_corner_masses(edges, one, other, vec4(xa.w, xb.w, xc.w, xd.w));
    vec3 impulse = self_impulse(gap, SelfCorners(moved(a), moved(b), moved(c), moved(d)), mass,
                                self_pair_thickness(one, other, edges, a, b, c, d), self_pair_friction(one, other),
                                push.recovery);
    if (impulse.x != 0.0f || impulse.y != 0.0f || impulse.z != 0.0f) {
        add(a, one.thickness, impulse, mass.x, gap.weights.x);
        add(b, edges ? one.thickness : other.thickness, impulse, mass.y, gap.weights.y);
        add(c, other.thickness, impulse, mass.z, gap.weights.z);
        add(d, other.thickness, impulse, mass.w, gap.weights.w);
        pushes = true;
    }
}

void main() {
    int points = self_both_listed(record[0].point_count, record[0].edge_count, push.pair_capacity);
    int edges = self_both_listed(record[0].edge_count, record[0].point_count, push.pair_capacity);
    FOR_EVERY(i, points, push_apart(false, pairs[i]))
    FOR_EVERY(i, edges, push_apart(true, pairs[push.pair_capacity - 1 - i]))
    dispatch(self_size_push + push.round, pushes ? uint(push.grid.x * push.grid.y) : 0u);
    if (push.round + 1 < self_iterations)
        dispatch(self_size_contact + push.round + 1, pushes ? uint(max(points, edges)) : 0u);
}
