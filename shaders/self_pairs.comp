// This pass lists the pairs of primitives that this substep may bring together, among those whose boxes are near each
// other. Particles and triangles fill a list from its begin, edges from its end, so that the passes that go through it
// know each pair's kind. It also begins with the pairs that touch: it lists how they lie, what they bore in the last
// substep and now begin with, and adds up how much contacts hold of every corner.
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
layout(set = 0, binding = 9, std430) writeonly buffer Touching { SelfTouch touching[]; };
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

struct Pair {
    uvec4 corners;
    SelfCloth one, other;
    SelfGap gap;
    float kept;  // thickness, m
};

Pair pair_of(bool edges, uvec4 corners) {
    SelfCloth one = cloth_at(self_texel(corners.x)), other = cloth_at(self_texel(corners.w));
    float kept = self_pair_thickness(one, other, edges, self_texel(corners.x), self_texel(corners.y),
                                     self_texel(corners.z), self_texel(corners.w));
    SelfCorners at = SelfCorners(where(corners.x), where(corners.y), where(corners.z), where(corners.w));
    return Pair(corners, one, other, self_gap(edges, at), kept);
}

uvec4 point_corners(uint entry) {
    ivec2 met = cells[self_near_cells(entry)];
    int k = self_near_kind(entry);
    ivec2 own = k < 2 ? met : met.yx;
    return self_point_pair(texel_of(own.x), texel_of(own.y), (k & 1) + 1);
}

uvec4 edge_corners(uint entry) {
    ivec2 met = cells[self_near_cells(entry)];
    int k = self_near_kind(entry), one = self_first_edge(k);
    return self_edge_pair(texel_of(met.x), one, texel_of(met.y), k - 3 * one);
}

/// Lists a pair that may meet. Returns whether it touches.
bool judge(bool edges, uvec4 corners) {
    Pair pair = pair_of(edges, corners);
    SelfCorners motions = SelfCorners(moved(corners.x), moved(corners.y), moved(corners.z), moved(corners.w));
    if (!self_listed_pair(edges, pair.gap, motions, pair.kept, self_mean_thickness(pair.one, pair.other))) return false;
    uint before = edges ? atomicAdd(record[0].edge_count, 1u) : atomicAdd(record[0].point_count, 1u);
    uint place = place_after(before, 1u);
    if (place < uint(push.pair_capacity)) pairs[edges ? uint(push.pair_capacity) - 1u - place : place] = corners;
    return self_touches(edges, pair.gap, motions, pair.kept);
}

/// Returns the force that a pair bore in the last substep, zero where it did not touch.
vec3 force_borne(bool edges, uvec4 pair) {
    vec3 force = vec3(0.0f, 0.0f, 0.0f);
    int chain = place_of(self_texel(pair.x)) * self_chains + self_chain(pair);
    for (uint k = first_borne[chain]; k != self_no_entry; k = borne[k].force.w >> 1)
        if (borne[k].corners == pair && ((borne[k].force.w & 1u) != 0u) == edges)
            force = uintBitsToFloat(borne[k].force.xyz);
    return force;
}

/// Lists a pair that touches, and begins with it.
void begin(bool edges, uvec4 corners) {
    Pair pair = pair_of(edges, corners);
    float friction = self_pair_friction(pair.one, pair.other);
    vec3 begun = self_begun(pair.gap.normal, force_borne(edges, corners), friction, push.step);
    vec4 weights = pair.gap.weights;
    uint place = edges ? atomicAdd(record[0].touching_edge_count, 1u) : atomicAdd(record[0].touching_point_count, 1u);
    touches = max(touches, place + 1u);
    if (place < uint(push.touching_capacity))
        touching[edges ? uint(push.touching_capacity) - 1u - place : place] =
            SelfTouch(corners, weights, vec4(pair.gap.normal, self_freedom(pair.gap.distance, pair.kept, push.step)),
                      vec4(begun, friction));
    add_weight(corners.x, self_weight(weights.x));
    add_weight(corners.y, self_weight(weights.y));
    add_weight(corners.z, self_weight(weights.z));
    add_weight(corners.w, self_weight(weights.w));
    if (begun.x != 0.0f || begun.y != 0.0f || begun.z != 0.0f) add_impulse(0, edges, corners, weights, begun);
}

void main() {
    carried = record[0].carried.xyz;
    int points = self_both_listed(record[0].near_point_count, record[0].near_edge_count, push.near_capacity);
    int edges = self_both_listed(record[0].near_edge_count, record[0].near_point_count, push.near_capacity);
    int last = push.near_capacity - 1;
    FOR_FOUND(i, points, judge(false, point_corners(near[i])), begin(false, point_corners(near[i])))
    FOR_FOUND(i, edges, judge(true, edge_corners(near[last - i])), begin(true, edge_corners(near[last - i])))
    dispatch(self_size_contact, touches);
    dispatch(self_size_push, touches > 0u ? uint(push.grid.x * push.grid.y) : 0u);
    dispatch(self_size_limit, reached);
}
