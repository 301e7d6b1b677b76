// This pass cuts short every motion that would go farther than was proved to cross nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;
#include "include/state_store.h"
VECTOR_OUT(7, DisplacementsOut, displacements_out);
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) readonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 5, rgba32f) uniform readonly imageBuffer before_in;
layout(set = 0, binding = 8, std430) writeonly buffer BeforeOut { vec4 before_out[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

struct Motion {
    bool held, cut;
    vec4 displacement;  // w: bits (self_sheet.h)
    vec3 bounded;       // displacement that contact allows, m
    float share;        // share of the motion that crosses nothing
};

Motion motion_of(int place) {
    float share = uintBitsToFloat(shares[(self_rounds - 1) * push.grid.x * push.grid.y + place]);
    ivec2 texel = texel_of(place);
    bool held = !(imageLoad(positions, texel).w > 0.0f);
    vec4 displacement = imageLoad(displacements_in, texel);
    vec3 allowed = self_bounded(displacement.xyz, imageLoad(before_in, place).xyz, carried, cloth_at(texel).thickness);
    vec3 bounded = held ? displacement.xyz : allowed;
    bool changed = bounded.x != displacement.x || bounded.y != displacement.y || bounded.z != displacement.z;
    return Motion(held, owner_of(place) >= 0 && (share < 1.0f || changed), displacement, bounded, share);
}

bool is_cut(int place) { return motion_of(place).cut; }

uint unproved = 0u, truncated = 0u;

void cut_short(int place) {
    Motion motion = motion_of(place);
    if (motion.held) {
        ++unproved;
    } else {
        ++truncated;
        vec3 moved = self_relative_motion(motion.bounded, carried);
        STORE_VECTOR(displacements_out, texel_of(place),
                     vec4(self_truncated(carried, moved, motion.share), motion.displacement.w));
        before_out[place].w = 1.0f;
    }
}

void count() {
    record[0].most_pairs = max(record[0].most_pairs, record[0].point_count + record[0].edge_count);
    record[0].most_near = max(record[0].most_near, record[0].near_point_count + record[0].near_edge_count);
    record[0].most_cells = max(max(record[0].most_cells, record[0].cell_count),
                               max(record[0].candidate_count, record[0].block_count));
}

void main() {
    carried = record[0].carried.xyz;
    FOR_FOUND(place, push.grid.x * push.grid.y, is_cut(place), cut_short(place))
    if (unproved > 0u) atomicAdd(record[0].unproved, unproved);
    if (truncated > 0u) atomicAdd(record[0].truncated, truncated);
    if (gl_GlobalInvocationID.x == 0u) count();
}
