// This pass runs when the margin of the last search is used up. It lists the pairs of blocks of 2 x 2 cells that this
// substep or later ones may bring together. Every block searches the tree of boxes for blocks near it, from its own
// place on, so that each pair is found once. The list has no defined order, so later passes must not depend on it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_tree.h"
layout(set = 0, binding = 1, std430) writeonly buffer Blocks { ivec2 blocks[]; };
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 5, std430) readonly buffer Meetings { uint meetings[]; };

/// Returns the cloth of a block. A block belongs to one cloth, since cloths begin at even columns and rows.
int block_owner(ivec2 block) { return owner_of(place_of(2 * block)); }

bool meets(int owner, SelfBox box, ivec2 block, SelfBox other_box) {
    int other = block_owner(block);
    if (other < 0 || meetings[owner % cloths_each() * cloths_each() + other % cloths_each()] == self_meets_not) return false;
    return self_boxes_meet(box, other_box, push, self_mean_thickness(cloths[owner], cloths[other]));
}

/// Returns whether a node of the tree has cells of the member whose rectangle begins at `corner`. Members do not touch
/// each other, but nothing keeps them apart in space, so their nodes would only be in the way.
bool is_of_member(ivec2 node, int level, ivec2 corner) {
    if (member_count == 1) return true;
    ivec2 end = corner + push.member_size, from = node << level, to = (node + 1) << level;
    return all(lessThan(from, end)) && all(greaterThan(to, corner));
}

void main() {
    ivec2 across = self_tree_size(push.grid, 1);
    int last = across.x * across.y - 1, begin = push.grid.x * push.grid.y;
    int index = min(int(gl_GlobalInvocationID.x), last);
    ivec2 own = ivec2(index % across.x, index / across.x), node = ivec2(0, 0);
    int owner = block_owner(own);
    bool searches = gl_GlobalInvocationID.x <= uint(last) && owner >= 0;
    precise float most = (cloth_at(2 * own).thickness + push.thickness) * 0.5f;
    ivec2 corner = 2 * own / push.member_size * push.member_size;
    int level = searches ? push.top : push.top + 1;
    int first = 0, visits = 0;  // first: index of the level's first box
    for (int below = 0; below < level && below < push.top; ++below) first += self_tree_count(push.grid, below);
    SelfBox box = box_at(begin + index);
    bool entered = true;
    while (level <= push.top) {
        ivec2 size = self_tree_size(push.grid, level);
        int place = first + node.y * size.x + node.x;
        bool open = entered && ((node.y + 1) << (level - 1)) > own.y && (level > 1 || place > begin + index) &&
                    is_of_member(node, level, corner) && self_boxes_meet(box, box_at(place), push, most);
        ++visits;
        if (visits > self_visit_limit) {
            atomicAdd(record[0].block_count, uint(push.cell_capacity));
            level = push.top;
            open = false;
            entered = false;
        }
        bool found = open && level == 1;
        // The only cloth of a scene needs no further test: it has self-contact, and `open` judged it by its own
        // thickness.
        if (cloth_count > 1) found = found && meets(owner, box, node, box_at(place));
        if (found) {
            uint at = atomicAdd(record[0].block_count, 1u);
            if (at < uint(push.cell_capacity)) blocks[at] = ivec2(index, place - begin);
        }
        if (open && level > 1) {
            --level;
            first -= self_tree_count(push.grid, level);
            node = ivec2(2 * node.x, 2 * node.y);
            continue;
        }
        bool right = (node.x & 1) == 0 && node.x + 1 < size.x;
        bool below = (node.y & 1) == 0 && node.y + 1 < size.y;
        entered = level < push.top && (right || below);
        if (entered) {
            node = right ? ivec2(node.x + 1, node.y) : ivec2(node.x & ~1, node.y + 1);
        } else {
            first += size.x * size.y;
            ++level;
            node = ivec2(node.x >> 1, node.y >> 1);
        }
    }
}
