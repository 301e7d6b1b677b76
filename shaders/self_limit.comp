// This pass computes, for every listed pair, the share of its motion that each corner may make and still remain on its
// side of the plane between the two. A particle keeps the smallest share over all its pairs; positive floats are
// ordered as their bits are. In the first round no particle has moved yet. Each later round begins with the motions
// that the previous round found to cross nothing: the planes have then moved too, so that layers that move together do
// not hold each other back. The pass runs only if the previous round cut a motion short. A free cloth of which
// the first round leaves a particle far behind for another cloth's sake makes the least share of any of its particles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 5, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 6, rgba32f) uniform readonly imageBuffer before;
layout(set = 0, binding = 7, std430) buffer Shares { uint shares[]; };
layout(set = 0, binding = 8, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"
layout(set = 0, binding = 9, std430) buffer ClothShares { uint cloth_shares[]; };
/// Returns the share that a particle made of its motion in a round: its own, or that of its cloth where this goes on as
/// a whole.
float share_made(float own, int owner, int round) {
    uint least = cloth_shares[owner * self_cloth_words + 1 + round];
    return cloth_shares[owner * self_cloth_words] != 0u ? uintBitsToFloat(least) : own;
}

#include "include/self_carried.h"
#include "include/self_sewn.h"

bool cuts_short = false;

struct Corner {
    int place, leader, owner;  // `owner`: the cloth, or the first of those that are sewn to it
    vec3 x;
    bool held;
    vec3 motion;         // m
    float along, share;  // its motion along the normal, m, and the share of it that it already makes
};

vec3 motion(Corner corner, uint which, float thickness) {
    vec3 moved = imageLoad(displacements, self_texel(which)).xyz;
    vec3 carried = carried_at(corner.place);
    if (!corner.held) moved = self_bounded(moved, imageLoad(before, corner.place).xyz, carried,
                                           own_thickness(corner.place, thickness));
    return self_relative_motion(moved, carried);
}

Corner corner_of(uint which) {
    ivec2 texel = self_texel(which);
    int place = place_of(texel), leader = leader_of(place);
    vec4 x = imageLoad(positions, texel);
    int last = (push.round - 1) * push.grid.x * push.grid.y + leader, owner = owner_of(place);
    if (sewn) owner = cloths[max(owner, 0)].body;
    bool held = !(x.w > 0.0f);
    float share = 0.0f;
    if (push.round > 0) {
        share = uintBitsToFloat(shares[last]);
        if (cloth_count > 1) share = held ? share : share_made(share, owner, push.round - 1);
    }
    return Corner(place, leader, owner, x.xyz, held, vec3(0.0f), 0.0f, share);
}

void bound(SelfGap gap, Corner corner, float middle, float end, float side, SelfCloth cloth, bool apart) {
    float share = self_share(gap, middle, end, side, corner.along, corner.share, corner.held, cloth.least);
    if (share < 1.0f) {
        atomicMin(shares[push.round * push.grid.x * push.grid.y + corner.leader], floatBitsToUint(share));
        cuts_short = true;
        if (cloth_count == 1 || corner.held) return;
        int own = corner.owner * self_cloth_words;
        atomicMin(cloth_shares[own + 1 + push.round], floatBitsToUint(share));
        bool alone = push.round == 0 && apart && cloth.held == 0;
        if (alone && self_stays_behind(corner.motion, share, cloth.spacing)) atomicOr(cloth_shares[own], 1u);
    }
}

void bound_pair(bool edges, uvec4 pair) {
    Corner a = corner_of(pair.x), b = corner_of(pair.y), c = corner_of(pair.z), d = corner_of(pair.w);
    SelfCloth one = cloth_at(self_texel(pair.x)), other = cloth_at(self_texel(pair.w));
    SelfGap gap = self_gap_squared(edges, SelfCorners(a.x, b.x, c.x, d.x));
    if (push.round == 0 && self_touch(gap)) atomicAdd(record[member_at(a.place)].unproved, 1u);
    a.motion = motion(a, pair.x, one.thickness);
    b.motion = motion(b, pair.y, edges ? one.thickness : other.thickness);
    c.motion = motion(c, pair.z, other.thickness);
    d.motion = motion(d, pair.w, other.thickness);
    a.along = ordered_dot(gap.normal, a.motion);
    b.along = ordered_dot(gap.normal, b.motion);
    c.along = ordered_dot(gap.normal, c.motion);
    d.along = ordered_dot(gap.normal, d.motion);
    vec4 end = self_ends(gap, vec4(a.along, b.along, c.along, d.along), vec4(a.share, b.share, c.share, d.share));
    vec4 wants = self_wants(vec4(a.along, b.along, c.along, d.along), vec4(a.share, b.share, c.share, d.share));
    float middle = self_middle(edges, gap.apart, end, wants);
    bool apart = one.body != other.body;
    bound(gap, a, middle, end.x, 1.0f, one, apart);
    bound(gap, b, middle, end.y, edges ? 1.0f : -1.0f, edges ? one : other, apart);
    bound(gap, c, middle, end.z, -1.0f, other, apart);
    bound(gap, d, middle, end.w, -1.0f, other, apart);
}

void main() {
    load_carried();
    int points = self_both_listed(record[0].point_count, record[0].edge_count, push.pair_capacity);
    int edges = self_both_listed(record[0].edge_count, record[0].point_count, push.pair_capacity);
    FOR_EVERY(i, points, bound_pair(false, pairs[i]))
    FOR_EVERY(i, edges, bound_pair(true, pairs[push.pair_capacity - 1 - i]))
    if (push.round + 1 < self_rounds)
        dispatch(self_size_limit + push.round + 1, cuts_short ? uint(max(points, edges)) : 0u);
}
