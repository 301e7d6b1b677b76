// After a search: lists the pairs of cells, no neighbours, of the blocks that it found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 1, std430) readonly buffer Blocks { ivec2 blocks[]; };
layout(set = 0, binding = 2, std430) buffer Candidates { ivec2 candidates[]; };
layout(set = 0, binding = 3, std430) buffer Record { SelfRecord record[]; };

/// Cell k (0..3) of a block.
ivec2 cell_of(int block, int k) {
    int across = self_tree_size(push.grid, 1).x;
    return ivec2(2 * (block % across) + (k & 1), 2 * (block / across) + (k >> 1));
}

bool inside(ivec2 cell) { return cell.x < push.grid.x && cell.y < push.grid.y; }
int index_of(ivec2 cell) { return min(cell.y, push.grid.y - 1) * push.grid.x + min(cell.x, push.grid.x - 1); }

void main() {
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    int count = record[0].search != 0u ? 4 * self_listed(record[0].block_count, push.cell_room) : 0;
    for (int i = int(gl_GlobalInvocationID.x); i < count; i += stride) {
        ivec2 pair = blocks[i >> 2];
        ivec2 a = cell_of(pair.x, i & 3);
        int first = index_of(a);
        SelfBox box = boxes[first];
        for (int k = 0; k < 4; ++k) {
            ivec2 b = cell_of(pair.y, k);
            int second = index_of(b);
            int lower = min(first, second), upper = max(first, second);
            bool may = inside(a) && inside(b) && !self_neighbours(a, b) &&
                       self_boxes_meet(box, boxes[second], push, push.margin);
            for (int found = may ? 1 : 0; found > 0; --found) {
                uint at = atomicAdd(record[0].candidate_count, 1u);
                if (at < uint(push.cell_room)) candidates[at] = ivec2(lower, upper);
            }
        }
    }
}
