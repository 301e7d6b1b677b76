// Lists the pairs of primitives that this substep may bring together: every particle goes through the tree of boxes for
// cells near its own, from its own on, so that no two cells are met twice. The list has no order, and what is made
// of it must not mind. MASKED: triangles that exist are read from an image (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, std430) readonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 4, std430) buffer Record { SelfRecord record[]; };
#ifdef MASKED
layout(set = 0, binding = 5, r32ui) uniform readonly uimage2D cells;
#endif

bool triangle_exists(ivec2 cell, int which) {
    if (!cell_inside(cell, push.grid)) return false;
#ifdef MASKED
    return (imageLoad(cells, cell).x & uint(which)) != 0u;
#else
    return true;
#endif
}

bool edge_exists(ivec2 particle, int k) {
    for (int side = 0; side < 2; ++side) {
        ivec4 owner = self_edge_owner(k, side);
        if (triangle_exists(particle + ivec2(owner.x, owner.y), owner.z)) return true;
    }
    return false;
}

vec3 where(uint corner) { return imageLoad(position, self_texel(corner)).xyz; }
vec3 moved(uint corner) { return imageLoad(displacement, self_texel(corner)).xyz; }

void add_pair(bool edges, uint a, uint b, uint c, uint d, float reach) {
    if (a == b || a == c || a == d || b == c || b == d) return;
    SelfCorners x = SelfCorners(where(a), where(b), where(c), where(d));
    if (self_far(edges, x, reach)) return;
    SelfGap gap = self_gap(edges, x);
    float approach = self_approach(edges, SelfCorners(moved(a), moved(b), moved(c), moved(d)));
    if (!(gap.distance < self_listing_distance(gap, push.thickness, push.thickness, approach))) return;
    float thickness =
        self_pair_thickness(push, edges, self_texel(a), self_texel(b), self_texel(c), self_texel(d));
    if (!(gap.distance < self_listing_distance(gap, thickness, push.thickness, approach))) return;
    uint place = atomicAdd(record[0].pair_count, 1u);
    if (place < uint(push.pair_room)) pairs[place] = uvec4(edges ? a | self_edge_pair : a, b, c, d);
}

void add_triangles(ivec2 particle, ivec2 cell, float reach) {
    for (int which = 1; which <= 2; ++which)
        if (triangle_exists(cell, which))
            add_pair(false, self_corner(particle), self_corner(cell + triangle_corner(which, 0)),
                     self_corner(cell + triangle_corner(which, 1)), self_corner(cell + triangle_corner(which, 2)),
                     reach);
}

void add_between(ivec2 a, ivec2 b, float reach) {
    add_triangles(a, b, reach);
    if (a == b) return;
    add_triangles(b, a, reach);
    for (int i = 0; i < 3; ++i) {
        if (!edge_exists(a, i)) continue;
        ivec4 one = self_edge(i);
        for (int k = 0; k < 3; ++k) {
            if (!edge_exists(b, k)) continue;
            ivec4 other = self_edge(k);
            add_pair(true, self_corner(a + ivec2(one.x, one.y)), self_corner(a + ivec2(one.z, one.w)),
                     self_corner(b + ivec2(other.x, other.y)), self_corner(b + ivec2(other.z, other.w)), reach);
        }
    }
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= push.grid.x * push.grid.y) return;
    ivec2 own = ivec2(index % push.grid.x, index / push.grid.x);
    SelfBox box = boxes[index];
    ivec2 node = ivec2(0, 0);
    int level = push.top, first = 0, visits = 0;  // first: box of the level
    for (int below = 0; below < push.top; ++below) first += self_tree_count(push.grid, below);
    bool entered = true;
    while (level <= push.top) {
        ivec2 size = self_tree_size(push.grid, level);
        int place = first + node.y * size.x + node.x;
        bool open = entered && ((node.y + 1) << level) > own.y && (level > 0 || place >= index) &&
                    self_boxes_meet(box, boxes[place], push);
        ++visits;
        if (open && level > 0) {
            --level;
            first -= self_tree_count(push.grid, level);
            node = ivec2(2 * node.x, 2 * node.y);
            continue;
        }
        if (open) {
            add_between(own, node, self_reach(box, boxes[place], push));
            visits += 32;  // loops there
        }
        if (visits > self_visit_limit) {
            atomicAdd(record[0].pair_count, uint(push.pair_room));
            return;
        }
        entered = true;
        if ((node.x & 1) == 0 && node.x + 1 < size.x) {
            ++node.x;
        } else if ((node.y & 1) == 0 && node.y + 1 < size.y) {
            node = ivec2(node.x & ~1, node.y + 1);
        } else {
            first += size.x * size.y;
            ++level;
            node = ivec2(node.x >> 1, node.y >> 1);
            entered = false;
        }
    }
}
