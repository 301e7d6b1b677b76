// Of every listed pair: the share of its motion that each corner may make and still be on its side of the plane between the
// two. A particle keeps the least of all its pairs'; positive floats order as their bits do. The first round begins
// with nobody moving, each next one with what the round before found to cross nothing: then the planes have moved too,
// and layers that move together are not held back by each other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, std430) readonly buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 3, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 4, std430) readonly buffer Before { vec4 before[]; };
layout(set = 0, binding = 5, std430) buffer Shares { uint shares[]; };

struct Corner {
    int index;
    vec3 x;
    bool held;
    float along, share;  // of its motion: m along the normal, and what it makes already
};

vec3 motion(int index, ivec2 texel, bool held) {
    vec3 moved = imageLoad(displacement, texel).xyz;
    if (!held) moved = self_bounded(moved, before[index].xyz, push.thickness);
    return self_relative_motion(moved, record[0].carried.xyz);
}

Corner corner_of(uint place) {
    ivec2 texel = self_texel(place);
    int index = texel.y * push.grid.x + texel.x;
    vec4 x = imageLoad(position, texel);
    int before = (push.round - 1) * push.grid.x * push.grid.y + index;
    float share = push.round > 0 ? uintBitsToFloat(shares[max(before, 0)]) : 0.0f;
    return Corner(index, x.xyz, !(x.w > 0.0f), 0.0f, share);
}

void bound(SelfGap gap, Corner corner, float middle, float end, float side) {
    float share =
        self_share(gap, middle, end, side, corner.along, corner.share, corner.held, push.least);
    if (!(share < 1.0f)) return;
    atomicMin(shares[push.round * push.grid.x * push.grid.y + corner.index], floatBitsToUint(share));
    atomicOr(record[0].short_rounds, 1u << push.round);
}

void main() {
    bool runs = push.round == 0 || (record[0].short_rounds & (1u << (push.round - 1))) != 0u;
    int count = runs ? self_listed(record[0].pair_count, push.pair_room) : 0;
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    for (int i = int(gl_GlobalInvocationID.x); i < count; i += stride) {
        uvec4 pair = pairs[i];
        bool edges = (pair.x & self_edge_pair) != 0u;
        Corner a = corner_of(pair.x), b = corner_of(pair.y), c = corner_of(pair.z), d = corner_of(pair.w);
        SelfGap gap = self_gap(edges, SelfCorners(a.x, b.x, c.x, d.x));
        a.along = ordered_dot(gap.normal, motion(a.index, self_texel(pair.x), a.held));
        b.along = ordered_dot(gap.normal, motion(b.index, self_texel(pair.y), b.held));
        c.along = ordered_dot(gap.normal, motion(c.index, self_texel(pair.z), c.held));
        d.along = ordered_dot(gap.normal, motion(d.index, self_texel(pair.w), d.held));
        vec4 end = self_ends(gap, vec4(a.along, b.along, c.along, d.along),
                             vec4(a.share, b.share, c.share, d.share));
        float middle = self_middle(edges, end);
        bound(gap, a, middle, end.x, 1.0f);
        bound(gap, b, middle, end.y, edges ? 1.0f : -1.0f);
        bound(gap, c, middle, end.z, -1.0f);
        bound(gap, d, middle, end.w, -1.0f);
    }
}
