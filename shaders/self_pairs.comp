// This pass lists, among the pairs of primitives whose boxes are near each other, those that this substep may bring
// together, and those of them that touch. Particles and triangles fill a list from its start, edges from its end, so
// that the passes that process it know each pair's kind.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
#include "include/self_sewn.h"
#include "include/self_skins.h"
layout(set = 0, binding = 4, std430) readonly buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) readonly buffer Near { uint near[]; };
layout(set = 0, binding = 6, std430) buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 8, std430) buffer Sizes { uvec4 sizes[]; };
layout(set = 0, binding = 9, std430) buffer Touching { SelfTouch touching[]; };
#include "include/self_lists.h"

#include "include/self_carried.h"
uint touches = 0u;

vec3 where(uint corner) { return imageLoad(positions, self_texel(corner)).xyz; }
vec3 moved(uint corner) {
    ivec2 texel = self_texel(corner);
    return self_relative_motion(imageLoad(displacements, texel).xyz, carried_at(texel));
}

uint leader(uint corner) { return uint(leader_of(place_of(self_texel(corner)))); }

/// Returns whether a pair is listed, and whether it touches. Two that a seam joins have a corner in common.
bvec2 found(bool edges, uvec4 pair) {
    if (sewn) {
        uvec4 leaders = uvec4(leader(pair.x), leader(pair.y), leader(pair.z), leader(pair.w));
        if (self_shares_corner(edges, leaders)) return bvec2(false);
    }
    SelfCloth one = cloth_at(self_texel(pair.x)), other = cloth_at(self_texel(pair.w));
    SelfGap gap = self_gap(edges, SelfCorners(where(pair.x), where(pair.y), where(pair.z), where(pair.w)));
    float kept = pair_skin(edges, pair, gap.weights).x;
    SelfCorners motions = SelfCorners(moved(pair.x), moved(pair.y), moved(pair.z), moved(pair.w));
    bool listed = self_listed_pair(edges, gap, motions, kept, self_mean_thickness(one, other));
    if (member_count > 1 && listed) atomicAdd(record[member_at(place_of(self_texel(pair.x)))].own_pairs, 1u);
    return bvec2(listed, listed && self_touches(edges, gap, motions, kept));
}

void judge_point(uint entry) {
    ivec2 met = cells[self_near_cells(entry)];
    int k = self_near_kind(entry);
    ivec2 own = k < 2 ? met : met.yx;
    uvec4 pair = self_point_pair(texel_of(own.x), texel_of(own.y), (k & 1) + 1);
    bvec2 is = found(false, pair);
    if (is.x) {
        uint place = place_after(atomicAdd(record[0].point_count, 1u), 1u);
        if (place < uint(push.pair_capacity)) pairs[place] = pair;
    }
    if (is.y) {
        uint place = atomicAdd(record[0].touching_point_count, 1u);
        touches = max(touches, place + 1u);
        if (place < uint(push.touching_capacity)) touching[place].corners = pair;
    }
}

void judge_edges(uint entry) {
    ivec2 met = cells[self_near_cells(entry)];
    int k = self_near_kind(entry), one = self_first_edge(k);
    uvec4 pair = self_edge_pair(texel_of(met.x), one, texel_of(met.y), k - 3 * one);
    bvec2 is = found(true, pair);
    if (is.x) {
        uint place = place_after(atomicAdd(record[0].edge_count, 1u), 1u);
        if (place < uint(push.pair_capacity)) pairs[uint(push.pair_capacity) - 1u - place] = pair;
    }
    if (is.y) {
        uint place = atomicAdd(record[0].touching_edge_count, 1u);
        touches = max(touches, place + 1u);
        if (place < uint(push.touching_capacity)) 
            touching[uint(push.touching_capacity) - 1u - place].corners = pair;
    }
}

void main() {
    load_carried();
    int points = self_both_listed(record[0].near_point_count, record[0].near_edge_count, push.near_capacity);
    int edges = self_both_listed(record[0].near_edge_count, record[0].near_point_count, push.near_capacity);
    FOR_EVERY(i, points, judge_point(near[i]))
    FOR_EVERY(i, edges, judge_edges(near[push.near_capacity - 1 - i]))
    dispatch(self_size_contact, touches);
    dispatch(self_size_push, touches > 0u ? uint(push.grid.x * push.grid.y) : 0u);
    dispatch(self_size_limit, reached);
}
