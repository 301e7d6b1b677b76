// Adds up what the listed pairs push their corners by: integers, so that the order does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, std430) readonly buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 3, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 4, std430) buffer Corrections { ivec4 corrections[]; };

vec3 moved(ivec2 texel) { return imageLoad(displacement, texel).xyz; }

void add(ivec2 texel, vec3 impulse, float mass, float weight) {
    int index = texel.y * push.grid.x + texel.x;
    precise float moves = mass * weight;
    precise float per_metre = self_correction_units / push.thickness;
    precise vec3 correction = impulse * moves;
    atomicAdd(corrections[index].x, self_units(correction.x, per_metre));
    atomicAdd(corrections[index].y, self_units(correction.y, per_metre));
    atomicAdd(corrections[index].z, self_units(correction.z, per_metre));
    atomicAdd(corrections[index].w, self_weight(weight));
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
        vec3 impulse = self_impulse(gap, SelfCorners(moved(a), moved(b), moved(c), moved(d)),
                                    vec4(xa.w, xb.w, xc.w, xd.w), self_pair_thickness(push, edges, a, b, c, d),
                                    push.friction, push.recovery);
        if (impulse.x == 0.0f && impulse.y == 0.0f && impulse.z == 0.0f) continue;
        add(a, impulse, xa.w, gap.weights.x);
        add(b, impulse, xb.w, gap.weights.y);
        add(c, impulse, xc.w, gap.weights.z);
        add(d, impulse, xd.w, gap.weights.w);
    }
}
