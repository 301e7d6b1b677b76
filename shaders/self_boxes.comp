// The tree of boxes over the sheet as it is at the start of a substep. LEAVES: its lowest level, a box per particle about
// the cell whose first corner that is; everything that the pairs of the substep will add up begins anew, and what the
// particles are to do before contact is kept. Else the levels from `level` to `last`, where several in one workgroup; the last of all says whether cells that may meet have
// to be searched.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants LEAVES
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
#ifdef LEAVES
#include "include/every.h"
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) writeonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 5, std430) writeonly buffer Corrections { ivec4 corrections[]; };
layout(set = 0, binding = 6, std430) writeonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 7, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 8, std430) writeonly buffer Before { vec4 before[]; };

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

SelfBox particle_box(ivec2 texel) {
    return self_point_box(imageLoad(positions, texel).xyz,
                          self_relative_motion(imageLoad(displacements, texel).xyz, carried));
}

SelfBox cell_box(ivec2 texel, SelfCloth cloth) {
    bool right = texel.x - cloth.first.x + 1 < cloth.grid.x;
    bool below = texel.y - cloth.first.y + 1 < cloth.grid.y;
    SelfBox box = particle_box(texel);
    if (right) box = self_joined(box, particle_box(texel + ivec2(1, 0)));
    if (below) box = self_joined(box, particle_box(texel + ivec2(0, 1)));
    if (right && below) box = self_joined(box, particle_box(texel + ivec2(1, 1)));
    return box;
}

void begin(int place, int count) {
        int owner = owner_of(place);
        SelfBox box = self_no_box();
        if (owner >= 0) box = cell_box(texel_of(place), cloth_at(texel_of(place)));
        boxes[place] = box;
        before[place] = vec4(imageLoad(displacements, texel_of(place)).xyz, 0.0f);
        corrections[place] = ivec4(0, 0, 0, 0);
        for (int round = 0; round < self_rounds; ++round) shares[round * count + place] = floatBitsToUint(1.0f);
}

void main() {
    carried = record[0].carried.xyz;
    int count = push.grid.x * push.grid.y;
    FOR_EVERY(place, count, begin(place, count))
}
#else
layout(set = 0, binding = 0, std430) buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 1, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 2, std430) buffer Sizes { uvec4 sizes[]; };

/// Box of the nodes below one.
SelfBox node_box(ivec2 node, ivec2 below, int first) {
    ivec2 corner = ivec2(2 * node.x, 2 * node.y);
    bool right = corner.x + 1 < below.x;
    bool lower = corner.y + 1 < below.y;
    int at = first + corner.y * below.x + corner.x;
    SelfBox box = boxes[at];
    if (right) box = self_joined(box, boxes[at + 1]);
    if (lower) box = self_joined(box, boxes[at + below.x]);
    if (right && lower) box = self_joined(box, boxes[at + below.x + 1]);
    return box;
}

void main() {
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    int first = 0;  // of the level below
    for (int level = 1; level < push.level; ++level) first += self_tree_count(push.grid, level - 1);
    for (int level = push.level; level <= push.last; ++level) {
        ivec2 below = self_tree_size(push.grid, level - 1), size = self_tree_size(push.grid, level);
        int own = first + below.x * below.y;
        for (int i = int(gl_GlobalInvocationID.x); i < size.x * size.y; i += stride)
            boxes[own + i] = node_box(ivec2(i % size.x, i / size.x), below, first);
        first = own;
        memoryBarrierBuffer();
        barrier();
    }
    if (push.last < push.top || gl_GlobalInvocationID.x > 0u) return;
    bool searches = self_searches(push, record[0].drift, boxes[first].lower.w);
    int blocks = searches ? self_tree_count(push.grid, 1) : 0;
    sizes[self_size_blocks] = uvec4(uint((blocks + workgroup_width - 1) / workgroup_width), 1u, 1u, 0u);
    sizes[self_size_cells] = uvec4(0u, 1u, 1u, 0u);
    if (!searches) return;
    sizes[self_size_near] = uvec4(0u, 1u, 1u, 0u);
    record[0].block_count = 0u;
    record[0].candidate_count = 0u;
    record[0].drift = 0.0f;
}
#endif
