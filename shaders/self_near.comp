// This pass lists the pairs of cells whose triangles and edges this substep may bring together. Of the candidates, none
// close in their cloth, it takes those whose boxes are near enough. After a search it first lists the candidates, until
// the next one: cells of the blocks that were found. Of a cloth's neighbours and those two columns or rows apart, it
// takes those about which the cloth is not flat and does not keep them apart. For these an invocation goes down a
// part of a column or two, so that from one cell to the next it loads one row of the 4 x 4 particles about it. A
// workgroup's z is its cloth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_ring.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 17) const int strip_rows = 1;     // most cells of a column that an invocation processes
layout(constant_id = 19) const int strip_columns = 1;  // columns that an invocation processes
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Meetings { uint meetings[]; };
layout(set = 0, binding = 5, std430) buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 7, std430) buffer Sizes { uvec4 sizes[]; };
layout(set = 0, binding = 8, rgba32f) uniform readonly imageBuffer boxes;
layout(set = 0, binding = 9, std430) buffer Candidates { ivec2 candidates[]; };
layout(set = 0, binding = 10, rgba32f) uniform readonly imageBuffer kept;
layout(set = 0, binding = 11, std430) readonly buffer Blocks { ivec2 blocks[]; };
#include "include/self_lists.h"

#include "include/self_carried.h"

SelfBox box_at(int place) { return SelfBox(imageLoad(boxes, 2 * place), imageLoad(boxes, 2 * place + 1)); }
SelfBox kept_at(int place) { return SelfBox(imageLoad(kept, 2 * place), imageLoad(kept, 2 * place + 1)); }

void judge_far(ivec2 pair) {
    float thickness = self_mean_thickness(cloth_at(texel_of(pair.x)), cloth_at(texel_of(pair.y)));
    if (self_boxes_meet(box_at(pair.x), box_at(pair.y), push, thickness)) {
        uint place = place_after(atomicAdd(record[0].cell_count, 1u), 1u);
        if (place < uint(push.cell_capacity)) cells[place] = pair;
    }
}

/// Returns cell k (0..3) of a block.
ivec2 cell_of(int block, int k) {
    return 2 * texel_of(block, self_tree_size(push.grid, 1).x) + ivec2(k & 1, k >> 1);
}

bool inside(ivec2 cell) { return cell.x < push.grid.x && cell.y < push.grid.y; }
int index_of(ivec2 cell) { return min(cell.y, push.grid.y - 1) * push.grid.x + min(cell.x, push.grid.x - 1); }

/// A block, with the boxes of its cells.
struct Block {
    ivec2 at;
    int cloth;
    SelfBox box0, box1, box2, box3;
};

Block block_of(int block) {
    ivec2 first = cell_of(block, 0);
    return Block(first, owner_of(place_of(first)), kept_at(index_of(first)), kept_at(index_of(cell_of(block, 1))),
                 kept_at(index_of(cell_of(block, 2))), kept_at(index_of(cell_of(block, 3))));
}

/// Returns whether cell k of one block may come near cell l of another. Cells past the sheet's edge do not count, and
/// neither do cells close to each other in their cloth, which are judged by how the cloth lies between them.
bool meet(Block one, SelfBox box, int k, Block other, SelfBox other_box, int l, float thickness) {
    ivec2 a = one.at + ivec2(k & 1, k >> 1), b = other.at + ivec2(l & 1, l >> 1);
    bool may = inside(a) && inside(b) && !(one.cloth == other.cloth && self_close(a, b));
    return may && self_boxes_meet(box, other_box, push, thickness);
}

/// Returns bits of the cells of another block that cell k of one meets.
uint cells_met(Block one, SelfBox box, int k, Block other, float thickness) {
    return (meet(one, box, k, other, other.box0, 0, thickness) ? 1u : 0u) |
           (meet(one, box, k, other, other.box1, 1, thickness) ? 2u : 0u) |
           (meet(one, box, k, other, other.box2, 2, thickness) ? 4u : 0u) |
           (meet(one, box, k, other, other.box3, 3, thickness) ? 8u : 0u);
}

void judge_blocks(ivec2 pair) {
    Block one = block_of(pair.x), other = block_of(pair.y);
    float thickness = self_mean_thickness(cloth_at(one.at), cloth_at(other.at));
    uint found = cells_met(one, one.box0, 0, other, thickness) | (cells_met(one, one.box1, 1, other, thickness) << 4) |
                 (cells_met(one, one.box2, 2, other, thickness) << 8) |
                 (cells_met(one, one.box3, 3, other, thickness) << 12);
    uint count = uint(bitCount(found)), place = 0u;
    if (count > 0u) place = atomicAdd(record[0].candidate_count, count);
    for (;;) {
        int k = max(findLSB(found), 0);
        int a = index_of(one.at + ivec2((k >> 2) & 1, k >> 3)), b = index_of(other.at + ivec2(k & 1, (k >> 1) & 1));
        ivec2 cells = ivec2(min(a, b), max(a, b));
        if (found != 0u && place < uint(push.cell_capacity)) candidates[place] = cells;
        if (found != 0u) judge_far(cells);
        ++place;
        found &= max(found, 1u) - 1u;
        if (found == 0u) break;
    }
}

/// After a search the candidates are the cells of the blocks that it found.
void judge_all_far() {
    ivec3 groups = ivec3(gl_NumWorkGroups), group = ivec3(gl_WorkGroupID);
    int own = (group.z * groups.y + group.y) * groups.x + group.x;
    int first = own * workgroup_width + int(gl_LocalInvocationIndex);
    int stride = groups.x * groups.y * groups.z * workgroup_width;
    bool searched = sizes[self_size_search].x != 0u;
    int block_count = searched ? self_listed(record[0].block_count, push.cell_capacity) : 0;
    int count = searched ? 0 : self_listed(record[0].candidate_count, push.cell_capacity);
    FOR_EVERY_FROM(i, first, stride, block_count, judge_blocks(blocks[i]))
    FOR_EVERY_FROM(i, first, stride, count, judge_far(candidates[i]))
}

SelfCloth cloth;  // the cloth whose close cells this workgroup processes

/// Returns where a particle of the cloth's grid lies on the sheet; beyond the grid, a particle of its last column or
/// row.
ivec2 texel_at(ivec2 own) { return cloth.first + min(own, cloth.grid - 1); }
vec3 at(ivec2 own) { return imageLoad(positions, texel_at(own)).xyz; }
vec3 moved(ivec2 own) {
    return self_relative_motion(imageLoad(displacements, texel_at(own)).xyz, carried_at(texel_at(own)));
}

SelfColumn column_at(ivec2 first) {
    return SelfColumn(at(first), at(first + ivec2(0, 1)), at(first + ivec2(0, 2)), at(first + ivec2(0, 3)));
}
SelfColumn column_moved(ivec2 first) {
    return SelfColumn(moved(first), moved(first + ivec2(0, 1)), moved(first + ivec2(0, 2)), moved(first + ivec2(0, 3)));
}

/// Returns a column of particles shifted by one row.
SelfColumn further(SelfColumn x, vec3 last) { return SelfColumn(x.b, x.c, x.d, last); }

/// Returns the first 3 x 3 of the 4 x 4 particles.
SelfPatch patch_of(SelfColumns x) {
    return SelfPatch(x.b.b, x.a.b, x.c.b, x.b.a, x.b.c, x.a.a, x.c.a, x.a.c, x.c.c);
}

/// Returns bits of the pairs for which a cell is responsible (self_close_pair) and that the cloth keeps apart.
uint kept_apart(SelfColumns x, SelfColumns motions, bool inside) {
    bool flat_there = inside && self_patch_lies_flat(push, cloth, patch_of(x), patch_of(motions));
    return self_close_apart(push, cloth, x, motions) | (flat_there ? (1u << self_neighbour_pairs) - 1u : 0u);
}

/// Returns bits of the pairs for which a cell is responsible (self_close_pair) and that exist.
uint close_pairs_of(ivec2 own) {
    uint bits = 0u;
    for (int k = 0; k < self_close_pairs; ++k) {
        ivec4 pair = self_close_pair(k);
        bool exists = own.x + max(pair.x, pair.z) < cloth.grid.x && own.y + max(pair.y, pair.w) < cloth.grid.y;
        bits |= exists ? 1u << k : 0u;
    }
    return bits;
}

/// Returns bits of the pairs for which a cell is responsible and that the shape of the cloth there does not rule out.
uint near_pairs(ivec2 own, SelfColumns x, SelfColumns motions) {
    bool inside = own.x + 2 < cloth.grid.x && own.y + 2 < cloth.grid.y;
    return close_pairs_of(own) & ~kept_apart(x, motions, inside);
}

/// Lists the pairs in `near`, which has self_close_pairs bits for each of some adjacent cells.
void list(ivec2 first, uint near) {
    uint count = uint(bitCount(near)), place = 0u;
    if (count > 0u) place = place_after(atomicAdd(record[0].cell_count, count), count);
    for (;;) {
        int bit = max(findLSB(near), 0), column = bit / self_close_pairs;
        ivec4 pair = self_close_pair(bit - column * self_close_pairs);
        ivec2 texel = cloth.first + first + ivec2(column, 0);
        ivec2 a = texel + ivec2(pair.x, pair.y), b = texel + ivec2(pair.z, pair.w);
        if (near != 0u && place < uint(push.cell_capacity)) cells[place] = ivec2(place_of(a), place_of(b));
        ++place;
        near &= max(near, 1u) - 1u;
        if (near == 0u) break;
    }
}

void judge_close() {
    int which = int(gl_WorkGroupID.z);
    cloth = push.cloth;
    if (cloth_count > 1) cloth = cloths[which];
    bool meets = meetings[which % cloths_each() * (cloths_each() + 1)] != self_meets_not;
    // The parts have equal length and are counted row by row, so that few lanes of a subgroup are idle.
    int parts = (cloth.grid.y - 1) / strip_rows + 1, rows = (cloth.grid.y - 1) / parts + 1;
    int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x),
        across = (cloth.grid.x - 1) / strip_columns + 1;
    ivec2 part = texel_of(group * workgroup_width + int(gl_LocalInvocationIndex), across);
    int first = part.x * strip_columns, y = part.y * rows, end = min(y + rows, cloth.grid.y);
    if (!meets || y >= end) return;
    SelfColumn x[5], motions[5];
    for (int c = 0; c < strip_columns + 3; ++c) {
        x[c] = column_at(ivec2(first + c, y));
        motions[c] = column_moved(ivec2(first + c, y));
    }
    for (;;) {
        // This is written out, since the driver does not unroll so long a loop.
        uint near = near_pairs(ivec2(first, y), SelfColumns(x[0], x[1], x[2], x[3]),
                               SelfColumns(motions[0], motions[1], motions[2], motions[3]));
        if (strip_columns > 1)
            near |= near_pairs(ivec2(first + 1, y), SelfColumns(x[1], x[2], x[3], x[4]),
                               SelfColumns(motions[1], motions[2], motions[3], motions[4]))
                    << self_close_pairs;
        list(ivec2(first, y), near);
        ++y;
        if (y >= end) break;
        for (int c = 0; c < strip_columns + 3; ++c) {
            x[c] = further(x[c], at(ivec2(first + c, y + 3)));
            motions[c] = further(motions[c], moved(ivec2(first + c, y + 3)));
        }
    }
}

void main() {
    load_carried();
    judge_all_far();
    judge_close();
    dispatch(self_size_primitives, reached);
}
