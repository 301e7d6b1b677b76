// This pass makes the boxes over the sheet as it is at the start of a substep, one per particle about the cell whose
// first corner that is. It resets the lists of what pairs bore by their first corner and keeps the motions that the
// particles would make without contact. CROSSED also resets what is found of cloths that started through each other.
// Where a cell has left the box with which it was last looked for, there is a new search, for which the pass makes the
// tree of boxes: they follow the cells' present motion, and have a margin. An invocation has a block of 2 x 2 cells,
// a workgroup the part of the tree over its blocks, and the last workgroup to come to its end what is above those parts.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants CROSSED
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) writeonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 5, std430) writeonly buffer FirstBorne { uint first_borne[]; };
layout(set = 0, binding = 6, std430) writeonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 8, std430) writeonly buffer Before { vec4 before[]; };
layout(set = 0, binding = 9, rgba32f) uniform readonly imageBuffer kept_in;       // level 0: boxes of the last search
layout(set = 0, binding = 10, std430) coherent buffer KeptOut { SelfBox kept_out[]; };  // levels above it
layout(set = 0, binding = 11, std430) buffer Sizes { uvec4 sizes[]; };
#ifdef CROSSED
layout(set = 0, binding = 12, std430) writeonly buffer Crossings { SelfCrossings crossings[]; };
void forget_crossings(int k) { crossings[k] = SelfCrossings(0, 0); }
#endif

shared SelfBox nodes[self_tile_nodes];
shared bool ends, looks;  // whether this workgroup is the last one, and whether there is a search

vec3 carried, travel, mean;  // those of record[0], read where nothing has branched yet (docs/devices.md)
bool searches = false;

struct Particle {
    SelfBox box;
    vec3 displacement;
};

/// Beyond the sheet its last column or row stands in.
Particle particle_at(ivec2 texel) {
    ivec2 inside = min(texel, push.grid - 1);
    vec3 displacement = imageLoad(displacements, inside).xyz;
    return Particle(self_point_box(imageLoad(positions, inside).xyz, self_relative_motion(displacement, carried)),
                    displacement);
}

/// Returns whether a cell has left the box with which it was looked for, or may have by rounding. The travel that all
/// cells have made since then brings none nearer to another, so it does not count. There is no && or ||, which would
/// branch.
bool has_left(SelfBox box, SelfBox was) {
    vec3 least = vec3(push.least);
    precise vec3 above = (box.lower.xyz - travel) - was.lower.xyz;
    precise vec3 below = was.upper.xyz - (box.upper.xyz - travel);
    bvec2 inside = bvec2(all(greaterThanEqual(above, least)), all(greaterThanEqual(below, least)));
    return !all(inside);
}

/// Begins with the cell of a particle, and returns its box for the tree.
SelfBox begin(ivec2 texel, Particle own, Particle at_right, Particle at_below, Particle last) {
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return self_no_box();
    int place = place_of(texel), count = push.grid.x * push.grid.y;
    bool owned = owner_of(place) >= 0;
    SelfCloth cloth = cloth_at(texel);
    bool right = texel.x - cloth.first.x + 1 < cloth.grid.x, below = texel.y - cloth.first.y + 1 < cloth.grid.y;
    SelfBox box = own.box;
    if (right) box = self_joined(box, at_right.box);
    if (below) box = self_joined(box, at_below.box);
    if (right && below) box = self_joined(box, last.box);
    if (!owned) box = self_no_box();
    boxes[place] = box;
    bool left = has_left(box, SelfBox(imageLoad(kept_in, 2 * place), imageLoad(kept_in, 2 * place + 1)));
    left = owned ? left : false;
    searches = left ? true : searches;
    before[place] = vec4(own.displacement, 0.0f);
    for (int chain = 0; chain < self_chains; ++chain) first_borne[place * self_chains + chain] = self_no_entry;
    for (int round = 0; round < self_rounds; ++round) shares[round * count + place] = floatBitsToUint(1.0f);
    SelfBox looked_for = self_no_box();
    if (owned) looked_for = self_kept_box(box, own.displacement, mean, push.margin);
    return looked_for;
}

SelfBox begin_block(ivec2 at) {
    Particle a = particle_at(at), b = particle_at(at + ivec2(1, 0)), c = particle_at(at + ivec2(2, 0)),
             d = particle_at(at + ivec2(0, 1)), e = particle_at(at + ivec2(1, 1)), f = particle_at(at + ivec2(2, 1)),
             g = particle_at(at + ivec2(0, 2)), h = particle_at(at + ivec2(1, 2)), i = particle_at(at + ivec2(2, 2));
    SelfBox box = begin(at, a, b, d, e);
    box = self_joined(box, begin(at + ivec2(1, 0), b, c, e, f));
    box = self_joined(box, begin(at + ivec2(0, 1), d, e, g, h));
    return self_joined(box, begin(at + ivec2(1, 1), e, f, h, i));
}

/// Index of the first box of a level.
int first_of(int level) {
    int first = 0;
    for (int below = 0; below < level; ++below) first += self_tree_count(push.grid, below);
    return first;
}

void keep(int level, ivec2 node, SelfBox box) {
    ivec2 size = self_tree_size(push.grid, level);
    if (level <= push.top && node.x < size.x && node.y < size.y)
        kept_out[first_of(level) + node.y * size.x + node.x] = box;
}

/// Makes the levels over a workgroup's blocks, of which this invocation has one. Past the sheet's edge boxes are empty.
void make_tile(SelfBox block) {
    int lane = int(gl_LocalInvocationIndex), side = self_tile_side, first = 0;
    ivec2 tile = ivec2(gl_WorkGroupID.xy), node = ivec2(lane % side, lane / side);
    nodes[lane] = block;
    keep(1, tile * side + node, block);
    for (int level = 2; level <= self_tile_top; ++level) {
        barrier();
        int below = first, across = side;
        first += side * side;
        side >>= 1;
        if (lane < side * side) {
            node = ivec2(lane % side, lane / side);
            int at = below + 2 * node.y * across + 2 * node.x;
            SelfBox box = self_joined(self_joined(self_joined(nodes[at], nodes[at + 1]), nodes[at + across]),
                                      nodes[at + across + 1]);
            nodes[first + lane] = box;
            keep(level, tile * side + node, box);
        }
    }
}

/// Returns the box of the up to four nodes below a node.
SelfBox node_box(ivec2 node, ivec2 below, int first) {
    ivec2 corner = ivec2(2 * node.x, 2 * node.y);
    bool right = corner.x + 1 < below.x;
    bool lower = corner.y + 1 < below.y;
    int at = first + corner.y * below.x + corner.x;
    SelfBox box = kept_out[at];
    if (right) box = self_joined(box, kept_out[at + 1]);
    if (lower) box = self_joined(box, kept_out[at + below.x]);
    if (right && lower) box = self_joined(box, kept_out[at + below.x + 1]);
    return box;
}

/// Makes the levels from one on, up to the `last`.
void make_levels(int from, int last) {
    int first = first_of(from - 1);
    for (int level = from; level <= last; ++level) {
        ivec2 below = self_tree_size(push.grid, level - 1), size = self_tree_size(push.grid, level);
        int own = first + below.x * below.y;
        for (int i = int(gl_LocalInvocationIndex); i < size.x * size.y; i += workgroup_width)
            kept_out[own + i] = node_box(ivec2(i % size.x, i / size.x), below, first);
        first = own;
        memoryBarrierBuffer();
        barrier();
    }
}

/// Finds whether this workgroup is the last to come here, and whether any has asked for a search.
void meet_at_end() {
    memoryBarrierBuffer();
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        ends = atomicAdd(sizes[self_size_search].w, 1u) + 1u == gl_NumWorkGroups.x * gl_NumWorkGroups.y;
        memoryBarrierBuffer();
        looks = ends && atomicOr(sizes[self_size_search].x, 0u) != 0u;
    }
    barrier();
    memoryBarrierBuffer();
}

void begin_search() {
    int blocks = self_tree_count(push.grid, 1);
    sizes[self_size_blocks].x = uint((blocks + workgroup_width - 1) / workgroup_width);
    record[0].block_count = 0u;
    record[0].candidate_count = 0u;
    record[0].travel = vec4(0.0f, 0.0f, 0.0f, 0.0f);
}

void main() {
    carried = record[0].carried.xyz;
    travel = record[0].travel.xyz;
    mean = record[0].mean.xyz;
    int lane = int(gl_LocalInvocationIndex);
    ivec2 tile = ivec2(gl_WorkGroupID.xy), block = ivec2(lane % self_tile_side, lane / self_tile_side);
    make_tile(begin_block(2 * (tile * self_tile_side + block)));
#ifdef CROSSED
    if (tile == ivec2(0, 0)) FOR_EVERY_FROM(k, lane, workgroup_width, push.crossed_count, forget_crossings(k))
#endif
    if (searches && sizes[self_size_search].x == 0u) atomicMax(sizes[self_size_search].x, 1u);
    meet_at_end();
    make_levels(self_tile_top + 1, looks ? push.top : 0);
    if (looks && lane == 0) begin_search();
}
