// This pass makes levels of the tree over the boxes with which cells are looked for, from `level` to `last`. Where
// these are several, it has one workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, std430) buffer Boxes { SelfBox boxes[]; };

/// Returns the box of the up to four nodes below a node.
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
    int first = 0;  // index of the first box of the level below
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
}
