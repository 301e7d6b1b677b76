// After a search: lists the pairs of cells, no neighbours, of the blocks that it found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 1, std430) readonly buffer Blocks { ivec2 blocks[]; };
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) buffer Candidates { ivec2 candidates[]; };
layout(set = 0, binding = 5, std430) buffer Record { SelfRecord record[]; };

/// Cell k (0..3) of a block.
ivec2 cell_of(int block, int k) {
    int across = self_tree_size(push.grid, 1).x;
    return ivec2(2 * (block % across) + (k & 1), 2 * (block / across) + (k >> 1));
}

bool inside(ivec2 cell) { return cell.x < push.grid.x && cell.y < push.grid.y; }
int index_of(ivec2 cell) { return min(cell.y, push.grid.y - 1) * push.grid.x + min(cell.x, push.grid.x - 1); }

/// Cells of a block and what they are in.
struct Block {
    ivec2 at;
    SelfBox box0, box1, box2, box3;
};

Block block_of(int block) {
    return Block(cell_of(block, 0), boxes[index_of(cell_of(block, 0))], boxes[index_of(cell_of(block, 1))],
                 boxes[index_of(cell_of(block, 2))], boxes[index_of(cell_of(block, 3))]);
}

/// Bits of the cells of a block that one may come near.
uint near(SelfBox box, Block other, float thickness) {
    return (self_boxes_meet(box, other.box0, push, thickness, push.margin) ? 1u : 0u) |
           (self_boxes_meet(box, other.box1, push, thickness, push.margin) ? 2u : 0u) |
           (self_boxes_meet(box, other.box2, push, thickness, push.margin) ? 4u : 0u) |
           (self_boxes_meet(box, other.box3, push, thickness, push.margin) ? 8u : 0u);
}

void main() {
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    int count = record[0].search != 0u ? self_listed(record[0].block_count, push.cell_room) : 0;
    for (int i = int(gl_GlobalInvocationID.x); i < count; i += stride) {
        ivec2 pair = blocks[i];
        Block one = block_of(pair.x), other = block_of(pair.y);
        float thickness = self_mean_thickness(cloth_at(one.at), cloth_at(other.at));
        uint found = near(one.box0, other, thickness) | (near(one.box1, other, thickness) << 4) |
                     (near(one.box2, other, thickness) << 8) | (near(one.box3, other, thickness) << 12);
        for (; found != 0u; found &= found - 1u) {
            int k = findLSB(found);
            ivec2 a = one.at + ivec2((k >> 2) & 1, k >> 3), b = other.at + ivec2(k & 1, (k >> 1) & 1);
            int first = index_of(a), second = index_of(b);
            int listed = inside(a) && inside(b) && !self_neighbours(a, b) ? 1 : 0;
            for (; listed > 0; --listed) {
                uint at = atomicAdd(record[0].candidate_count, 1u);
                if (at < uint(push.cell_room)) candidates[at] = ivec2(min(first, second), max(first, second));
            }
        }
    }
}
