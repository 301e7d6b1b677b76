// Cuts the motions short that would go farther than was proved to cross nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;
#include "include/state_store.h"
VECTOR_OUT(7, DisplacementsOut, displacements_out);
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) readonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 5, std430) buffer Before { vec4 before[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

void move(int place, float thickness) {
    float share = uintBitsToFloat(shares[(self_rounds - 1) * push.grid.x * push.grid.y + place]);
    ivec2 texel = texel_of(place);
    bool held = !(imageLoad(positions, texel).w > 0.0f);
    vec4 displacement = imageLoad(displacements_in, texel);
    vec3 first = before[place].xyz;
    vec3 bounded = held ? displacement.xyz : self_bounded(displacement.xyz, first, carried, thickness);
    bool changed = bounded.x != displacement.x || bounded.y != displacement.y || bounded.z != displacement.z;
    bool cut = share < 1.0f || changed;
    vec3 moved = self_relative_motion(bounded, carried);
    if (cut && held) atomicAdd(record[0].unproved, 1u);
    if (cut && !held) {
        atomicAdd(record[0].truncated, 1u);
        STORE_VECTOR(displacements_out, texel, vec4(self_truncated(carried, moved, share), displacement.w));
        before[place].w = 1.0f;
    }
}

void count() {
    record[0].most_pairs = max(record[0].most_pairs, record[0].point_count + record[0].edge_count);
    record[0].most_near = max(record[0].most_near, record[0].near_point_count + record[0].near_edge_count);
    record[0].most_cells = max(max(record[0].most_cells, record[0].cell_count),
                               max(record[0].candidate_count, record[0].block_count));
}

void move_own(int place) {
    if (owner_of(place) >= 0) move(place, cloth_at(texel_of(place)).thickness);
}

void main() {
    carried = record[0].carried.xyz;
    FOR_EVERY(place, push.grid.x * push.grid.y, move_own(place))
    if (gl_GlobalInvocationID.x == 0u) count();
}
