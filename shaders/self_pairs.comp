// This pass lists the pairs of primitives that this substep may bring together, among those whose boxes are near each
// other, and those of them that touch, with what they bore in the last substep. Particles and triangles fill a list
// from its begin, edges from its end, so that the passes that go through it know each pair's kind.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants WIDE
#ifdef WIDE  // both parts of a component share an atomic of 64 bits, which halves the atomics
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) readonly buffer Near { uint near[]; };
layout(set = 0, binding = 6, std430) buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 8, std430) buffer Sizes { uvec4 sizes[]; };
layout(set = 0, binding = 9, std430) buffer Touching { SelfTouch touching[]; };
layout(set = 0, binding = 10, std430) readonly buffer FirstBorne { uint first_borne[]; };
layout(set = 0, binding = 11, std430) readonly buffer Borne { SelfBorne borne[]; };
#define SUMS_SLOT 12
#include "include/self_sums.h"
#include "include/self_lists.h"

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)
uint touches = 0u;

vec3 where(uint corner) { return imageLoad(positions, self_texel(corner)).xyz; }
vec3 moved(uint corner) {
    return self_relative_motion(imageLoad(displacements, self_texel(corner)).xyz, carried);
}

/// What is known of a pair that is near.
struct Found {
    SelfGap gap;
    float kept, friction;  // its thickness, m
    bool listed, touches;
};

Found found_of(bool edges, uvec4 pair) {
    SelfCloth one = cloth_at(self_texel(pair.x)), other = cloth_at(self_texel(pair.w));
    float kept = self_pair_thickness(one, other, edges, self_texel(pair.x), self_texel(pair.y), self_texel(pair.z),
                                     self_texel(pair.w));
    SelfGap gap = self_gap(edges, SelfCorners(where(pair.x), where(pair.y), where(pair.z), where(pair.w)));
    SelfCorners motions = SelfCorners(moved(pair.x), moved(pair.y), moved(pair.z), moved(pair.w));
    bool listed = self_listed_pair(edges, gap, motions, kept, self_mean_thickness(one, other));
    return Found(gap, kept, self_pair_friction(one, other), listed,
                 listed && self_touches(edges, gap, motions, kept));
}

/// Returns the force that a pair bore in the last substep, zero where it did not touch.
vec3 force_borne(bool edges, uvec4 pair) {
    vec3 force = vec3(0.0f, 0.0f, 0.0f);
    for (uint k = first_borne[place_of(self_texel(pair.x))]; k != self_no_entry; k = borne[k].force.w >> 1)
        if (borne[k].corners == pair && ((borne[k].force.w & 1u) != 0u) == edges) force = uintBitsToFloat(borne[k].force.xyz);
    return force;
}

void touch(bool edges, uvec4 pair, Found found, uint entry) {
    vec3 begun = self_begun(found.gap.normal, force_borne(edges, pair), found.friction, push.step);
    vec4 weights = found.gap.weights;
    touching[entry] =
        SelfTouch(pair, weights,
                  vec4(found.gap.normal, self_freedom(found.gap.distance, found.kept, push.step)),
                  vec4(begun, found.friction));
    add_weight(pair.x, self_weight(weights.x));
    add_weight(pair.y, self_weight(weights.y));
    add_weight(pair.z, self_weight(weights.z));
    add_weight(pair.w, self_weight(weights.w));
    if (begun.x != 0.0f || begun.y != 0.0f || begun.z != 0.0f) add_impulse(0, edges, pair, weights, begun);
}

void judge_point(uint entry) {
    ivec2 met = cells[self_near_cells(entry)];
    int k = self_near_kind(entry);
    ivec2 own = k < 2 ? met : met.yx;
    uvec4 pair = self_point_pair(texel_of(own.x), texel_of(own.y), (k & 1) + 1);
    Found found = found_of(false, pair);
    if (found.listed) {
        uint place = place_after(atomicAdd(record[0].point_count, 1u), 1u);
        if (place < uint(push.pair_capacity)) pairs[place] = pair;
    }
    if (found.touches) {
        uint place = atomicAdd(record[0].touching_point_count, 1u);
        touches = max(touches, place + 1u);
        if (place < uint(push.touching_capacity)) touch(false, pair, found, place);
    }
}

void judge_edges(uint entry) {
    ivec2 met = cells[self_near_cells(entry)];
    int k = self_near_kind(entry), one = self_first_edge(k);
    uvec4 pair = self_edge_pair(texel_of(met.x), one, texel_of(met.y), k - 3 * one);
    Found found = found_of(true, pair);
    if (found.listed) {
        uint place = place_after(atomicAdd(record[0].edge_count, 1u), 1u);
        if (place < uint(push.pair_capacity)) pairs[uint(push.pair_capacity) - 1u - place] = pair;
    }
    if (found.touches) {
        uint place = atomicAdd(record[0].touching_edge_count, 1u);
        touches = max(touches, place + 1u);
        if (place < uint(push.touching_capacity)) touch(true, pair, found, uint(push.touching_capacity) - 1u - place);
    }
}

void main() {
    carried = record[0].carried.xyz;
    int points = self_both_listed(record[0].near_point_count, record[0].near_edge_count, push.near_capacity);
    int edges = self_both_listed(record[0].near_edge_count, record[0].near_point_count, push.near_capacity);
    FOR_EVERY(i, points, judge_point(near[i]))
    FOR_EVERY(i, edges, judge_edges(near[push.near_capacity - 1 - i]))
    dispatch(self_size_contact, touches);
    dispatch(self_size_push, touches > 0u ? uint(push.grid.x * push.grid.y) : 0u);
    dispatch(self_size_limit, reached);
}
