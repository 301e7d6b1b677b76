// This pass runs after a search and lists the pairs of cells of the blocks that it found, without those that are close
// in their cloth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_tree.h"
layout(set = 0, binding = 1, std430) readonly buffer Blocks { ivec2 blocks[]; };
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) buffer Candidates { ivec2 candidates[]; };
layout(set = 0, binding = 5, std430) buffer Record { SelfRecord record[]; };

/// Returns cell k (0..3) of a block.
ivec2 cell_of(int block, int k) {
    return 2 * texel_of(block, self_tree_size(push.grid, 1).x) + ivec2(k & 1, k >> 1);
}

bool inside(ivec2 cell) { return cell.x < push.grid.x && cell.y < push.grid.y; }
int index_of(ivec2 cell) { return min(cell.y, push.grid.y - 1) * push.grid.x + min(cell.x, push.grid.x - 1); }

/// The cells of a block lie in these boxes.
struct Block {
    ivec2 at;
    int cloth;
    SelfBox box0, box1, box2, box3;
};

Block block_of(int block) {
    ivec2 first = cell_of(block, 0);
    return Block(first, owner_of(place_of(first)), box_at(index_of(cell_of(block, 0))), box_at(index_of(cell_of(block, 1))),
                 box_at(index_of(cell_of(block, 2))), box_at(index_of(cell_of(block, 3))));
}

/// Returns whether cell k of one block may come near cell l of another. Cells past the sheet's edge do not count, nor
/// do cells close in their cloth, which self_near.comp judges by how the cloth lies between them.
bool meet(Block one, SelfBox box, int k, Block other, SelfBox other_box, int l, float thickness) {
    ivec2 a = one.at + ivec2(k & 1, k >> 1), b = other.at + ivec2(l & 1, l >> 1);
    bool may = inside(a) && inside(b) && !(one.cloth == other.cloth && self_close(a, b));
    return may && self_boxes_meet(box, other_box, push, thickness);
}

/// Returns bits of the cells of another block that cell k of one meets.
uint near(Block one, SelfBox box, int k, Block other, float thickness) {
    return (meet(one, box, k, other, other.box0, 0, thickness) ? 1u : 0u) |
           (meet(one, box, k, other, other.box1, 1, thickness) ? 2u : 0u) |
           (meet(one, box, k, other, other.box2, 2, thickness) ? 4u : 0u) |
           (meet(one, box, k, other, other.box3, 3, thickness) ? 8u : 0u);
}

void judge(ivec2 pair) {
    Block one = block_of(pair.x), other = block_of(pair.y);
    float thickness = self_mean_thickness(cloth_at(one.at), cloth_at(other.at));
    uint found = near(one, one.box0, 0, other, thickness) | (near(one, one.box1, 1, other, thickness) << 4) |
                 (near(one, one.box2, 2, other, thickness) << 8) | (near(one, one.box3, 3, other, thickness) << 12);
    uint count = uint(bitCount(found)), place = 0u;
    if (count > 0u) place = atomicAdd(record[0].candidate_count, count);
    for (;;) {
        int k = max(findLSB(found), 0);
        int a = index_of(one.at + ivec2((k >> 2) & 1, k >> 3)), b = index_of(other.at + ivec2(k & 1, (k >> 1) & 1));
        if (found != 0u && place < uint(push.cell_capacity)) candidates[place] = ivec2(min(a, b), max(a, b));
        ++place;
        found &= max(found, 1u) - 1u;
        if (found == 0u) break;
    }
}

void main() {
    int count = self_listed(record[0].block_count, push.cell_capacity);
    FOR_EVERY(i, count, judge(blocks[i]))
}
