// This pass runs when there is a new search. It computes the boxes with which cells are searched for in this substep
// and later ones, which follow the cells' present motion and have a margin, and the tree over them. An invocation has 4
// x 4 cells, a workgroup the part of the tree over its cells, and the last workgroup to finish computes the levels
// above.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly imageBuffer boxes;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements;
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 5, std430) coherent buffer Kept { SelfBox kept[]; };
layout(set = 0, binding = 6, std430) buffer Sizes { uvec4 sizes[]; };

const int side = self_tile_side;
shared SelfBox nodes[side * side * 4 / 3];  // in the levels over a workgroup's cells, each a quarter of the one below
shared bool is_last;                        // this workgroup is the last to finish

vec3 first_mean;  // record[0].mean, read before anything has branched (docs/devices.md)
vec3 mean_at(int place) {
    vec3 mean = first_mean;
    if (member_count > 1) mean = record[member_at(place)].mean.xyz;
    return mean;
}

/// Stores the box of a node in the level whose first box is `first`; nodes past the sheet's edge do not exist.
void keep(int first, ivec2 size, ivec2 node, SelfBox box) {
    if (node.x < size.x && node.y < size.y) kept[first + node.y * size.x + node.x] = box;
}

SelfBox joined(SelfBox a, SelfBox b, SelfBox c, SelfBox d) {
    return self_joined(self_joined(self_joined(a, b), c), d);
}

SelfBox cell_box(ivec2 texel) {
    ivec2 inside = min(texel, push.grid - 1);
    int place = place_of(inside);
    SelfBox own = SelfBox(imageLoad(boxes, 2 * place), imageLoad(boxes, 2 * place + 1));
    SelfBox box = self_kept_box(own, imageLoad(displacements, inside).xyz, mean_at(place), push.margin);
    bool is_cell = inside == texel && owner_of(place) >= 0;
    if (!is_cell) box = self_no_box();
    keep(0, push.grid, texel, box);
    return box;
}

SelfBox block_box(ivec2 block) {
    ivec2 at = 2 * block;
    SelfBox box = joined(cell_box(at), cell_box(at + ivec2(1, 0)), cell_box(at + ivec2(0, 1)), cell_box(at + 1));
    keep(push.grid.x * push.grid.y, self_tree_size(push.grid, 1), block, box);
    return box;
}

/// Computes the levels over this invocation's cells, then those over the workgroup's, up to the one with a single box.
/// Returns the index of that level's first box.
int make_tile(ivec2 tile) {
    int lane = int(gl_LocalInvocationIndex), across = side, below = 0;
    ivec2 node = ivec2(lane & (across - 1), lane / side), own = tile * across + node, at = 2 * own;
    nodes[lane] = joined(block_box(at), block_box(at + ivec2(1, 0)), block_box(at + ivec2(0, 1)), block_box(at + 1));
    int first = push.grid.x * push.grid.y + self_tree_count(push.grid, 1);
    if (push.top >= 2) keep(first, self_tree_size(push.grid, 2), own, nodes[lane]);
    for (int level = 3, bits = 2; level <= self_tile_top; ++level, --bits) {
        barrier();
        first += self_tree_count(push.grid, level - 1);
        int next = below + across * across, half_across = across >> 1;
        if (lane < half_across * half_across) {
            node = ivec2(lane & (half_across - 1), lane >> bits);
            int from = below + 2 * node.y * across + 2 * node.x;
            SelfBox box = joined(nodes[from], nodes[from + 1], nodes[from + across], nodes[from + across + 1]);
            nodes[next + lane] = box;
            if (level <= push.top) keep(first, self_tree_size(push.grid, level), tile * half_across + node, box);
        }
        below = next;
        across = half_across;
    }
    return first;
}

/// Computes a node, in the level whose first box is `own`, from the up to four nodes below it.
void make_node(ivec2 node, ivec2 size, int own, ivec2 below, int first) {
    ivec2 corner = 2 * node;
    bool right = corner.x + 1 < below.x;
    bool lower = corner.y + 1 < below.y;
    int at = first + corner.y * below.x + corner.x;
    SelfBox box = kept[at];
    if (right) box = self_joined(box, kept[at + 1]);
    if (lower) box = self_joined(box, kept[at + below.x]);
    if (right && lower) box = self_joined(box, kept[at + below.x + 1]);
    keep(own, size, node, box);
}

/// Computes all levels above the workgroups' parts, whose highest level begins with the box `first`.
void make_rest(int first, int last) {
    for (int level = self_tile_top + 1; level <= last; ++level) {
        ivec2 below = self_tree_size(push.grid, level - 1), size = self_tree_size(push.grid, level);
        int own = first + below.x * below.y;
        for (int i = int(gl_LocalInvocationIndex); i < size.x * size.y; i += workgroup_width)
            make_node(texel_of(i, size.x), size, own, below, first);
        first = own;
        memoryBarrierBuffer();
        barrier();
    }
}

void main() {
    first_mean = record[0].mean.xyz;
    int first = make_tile(ivec2(gl_WorkGroupID.xy));
    memoryBarrierBuffer();
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        is_last = atomicAdd(sizes[self_size_tree].w, 1u) + 1u == gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    barrier();
    memoryBarrierBuffer();
    make_rest(first, is_last ? push.top : 0);
}
