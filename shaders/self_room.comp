// Of every listed pair: the share of its displacement that each corner may make before it is halfway to the plane between
// the two. A particle keeps the least of all its pairs'; positive floats order as their bits do.
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
layout(set = 0, binding = 4, std430) readonly buffer Limits { float limits[]; };
layout(set = 0, binding = 5, std430) buffer Shares { uint shares[]; };

void bound(SelfGap gap, ivec2 texel, float inverse_mass, float room, float side) {
    int index = texel.y * push.grid.x + texel.x;
    bool held = !(inverse_mass > 0.0f);
    vec3 moved = imageLoad(displacement, texel).xyz;
    vec3 bounded = held ? moved : self_bounded(moved, limits[index]);
    float share = self_share(gap, room, side, bounded, held ? self_held_share : self_room_share, push.least);
    if (!(share < 1.0f)) return;
    if (held)
        atomicAdd(record[0].unproved, 1u);
    else
        atomicMin(shares[index], floatBitsToUint(share));
}

void main() {
    int count = self_listed(record[0].pair_count, push.pair_room);
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    for (int i = int(gl_GlobalInvocationID.x); i < count; i += stride) {
        uvec4 pair = pairs[i];
        bool edges = (pair.x & self_edge_pair) != 0u;
        ivec2 a = self_texel(pair.x), b = self_texel(pair.y), c = self_texel(pair.z), d = self_texel(pair.w);
        vec4 xa = imageLoad(position, a), xb = imageLoad(position, b), xc = imageLoad(position, c),
             xd = imageLoad(position, d);
        SelfGap gap = self_gap(edges, SelfCorners(xa.xyz, xb.xyz, xc.xyz, xd.xyz));
        bound(gap, a, xa.w, gap.room.x, 1.0f);
        bound(gap, b, xb.w, gap.room.y, edges ? 1.0f : -1.0f);
        bound(gap, c, xc.w, gap.room.z, -1.0f);
        bound(gap, d, xd.w, gap.room.w, -1.0f);
    }
}
