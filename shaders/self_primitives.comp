// Of the cells that were found near each other, lists the pairs of primitives whose boxes are: particles and triangles from
// the list's begin on, edges from its end on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) buffer Near { ivec2 near[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 7, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

/// Boxes of what a cell's first particle owns.
struct Cell {
    ivec2 at;
    uint bits;  // of the triangles and edges that exist
    SelfBox particle, upper, lower, along, across, diagonal;
};

SelfBox box_at(ivec2 texel, vec3 displacement) {
    return self_point_box(imageLoad(positions, texel).xyz,
                          self_relative_motion(displacement, carried));
}
SelfBox box_at(ivec2 texel) { return box_at(texel, imageLoad(displacements, texel).xyz); }

Cell cell_of(int place) {
    ivec2 own = texel_of(place);
    vec4 displacement = imageLoad(displacements, own);
    SelfBox first = box_at(own, displacement.xyz), right = box_at(own + ivec2(1, 0)),
            below = box_at(own + ivec2(0, 1)), last = box_at(own + ivec2(1, 1));
    SelfBox diagonal = self_joined(right, below);
    return Cell(own, uint(displacement.w), first, self_joined(first, diagonal), self_joined(last, diagonal),
                self_joined(first, right), self_joined(first, below), diagonal);
}

uint meets(SelfBox one, SelfBox other, float thickness) {
    return self_primitives_meet(one, other, push, thickness) ? 1u : 0u;
}

/// Bits of the triangles of a cell that exist and that a particle may meet.
uint triangles_met(Cell one, Cell other, float thickness) {
    uint bits = meets(one.particle, other.upper, thickness) | (meets(one.particle, other.lower, thickness) << 1);
    return bits & other.bits & 3u;
}

/// Bits of its edges that exist and that edge k of another may meet.
uint edges_met(Cell one, int k, SelfBox edge, Cell other, float thickness) {
    uint bits = meets(edge, other.along, thickness) | (meets(edge, other.across, thickness) << 1) |
                (meets(edge, other.diagonal, thickness) << 2);
    return (one.bits & (4u << k)) != 0u ? bits & (other.bits >> 2) : 0u;
}

uint met(Cell one, Cell other, float thickness) {
    uint edges = edges_met(one, 0, one.along, other, thickness) |
                 (edges_met(one, 1, one.across, other, thickness) << 3) |
                 (edges_met(one, 2, one.diagonal, other, thickness) << 6);
    uint bits = triangles_met(one, other, thickness) | (triangles_met(other, one, thickness) << 2) |
                (edges << self_first_edge_pair);
    return bits & self_disjoint(other.at.x - one.at.x, other.at.y - one.at.y);
}

void list_points(ivec2 pair, uint bits) {
    uint count = uint(bitCount(bits)), place = 0u;
    if (count > 0u) place = place_after(atomicAdd(record[0].near_point_count, count), count);
    for (int k = 0; k < self_first_edge_pair; ++k) {
        bool listed = (bits & (1u << k)) != 0u;
        ivec2 own = k < 2 ? pair : pair.yx;
        if (listed && place < uint(push.near_room)) near[place] = ivec2(own.x, own.y * 2 + (k & 1));
        place += listed ? 1u : 0u;
    }
}

void list_edges(ivec2 pair, uint bits) {
    uint count = uint(bitCount(bits)), place = 0u;
    if (count > 0u) place = place_after(atomicAdd(record[0].near_edge_count, count), count);
    for (;;) {
        int k = findLSB(bits);
        if (k >= 0 && place < uint(push.near_room))
            near[uint(push.near_room) - 1u - place] = pair * 4 + ivec2(k / 3, k % 3);
        ++place;
        bits &= max(bits, 1u) - 1u;
        if (bits == 0u) break;
    }
}

void judge(ivec2 pair) {
    Cell one = cell_of(pair.x), other = cell_of(pair.y);
    uint bits = met(one, other, self_mean_thickness(cloth_at(one.at), cloth_at(other.at)));
    list_points(pair, bits & ((1u << self_first_edge_pair) - 1u));
    list_edges(pair, bits >> self_first_edge_pair);
}

void main() {
    carried = record[0].carried.xyz;
    int count = self_listed(record[0].cell_count, push.cell_room);
    FOR_EVERY(i, count, judge(cells[i]))
    dispatch(self_size_pairs, reached);
}
