// This pass lists the pairs of primitives whose boxes are near each other, among the pairs of near cells. Particles and
// triangles fill the list from its start, edges from its end. It also resets the sums of the impulses to come, and
// chains what pairs bore by their first corners. It leaves out cloths that `crossed` when they started and still do.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) buffer Near { uint near[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 7, std430) buffer Sizes { uvec4 sizes[]; };
layout(constant_id = 24) const bool crossed = false;
layout(set = 0, binding = 8, std430) readonly buffer Meetings { uint meetings[]; };
layout(set = 0, binding = 9, std430) readonly buffer Crossings { SelfCrossings crossings[]; };
#include "include/self_lists.h"
layout(set = 0, binding = 10, std430) writeonly buffer Sums { uvec4 sums_out[]; };  // two each
layout(set = 0, binding = 13, rgba32f) uniform readonly imageBuffer sums_in;  // integers, as bits
layout(set = 0, binding = 11, std430) buffer FirstBorne { uint first_borne[]; };
layout(set = 0, binding = 12, std430) buffer Borne { SelfBorne borne[]; };

/// Returns whether the last pairs that touched left sums at a place. Most particles touch nothing, and a store costs more
/// than ten loads.
bool is_left(int place) { return floatBitsToUint(imageLoad(sums_in, 2 * place + 1).w) != 0u; }
void clear(int place) {
    for (int sum = 0; sum < self_sum_count; ++sum)
        for (int half_sum = 0; half_sum < 2; ++half_sum)
            sums_out[2 * (sum * push.grid.x * push.grid.y + place) + half_sum] = uvec4(0u);
}
void chain(int entry) {
    uvec4 pair = borne[entry + 1].corners;
    int chain = place_of(self_texel(pair.x)) * self_chains + self_chain(pair);
    uint next = atomicExchange(first_borne[chain], uint(entry + 1));
    borne[entry + 1].force.w = next * 2u + (borne[entry + 1].force.w & 1u);
}

#include "include/self_carried.h"

/// A cell, with the boxes of its first particle and of the triangles and edges that this particle owns.
struct Cell {
    ivec2 at;
    uint bits;  // bits of the triangles and edges that exist, and of the particle
    SelfBox particle, upper, lower, along, across, diagonal;
};

struct Corner {
    vec3 at, motion;  // place at the substep's start, and motion relative to the common one, m
};
Corner corner_at(ivec2 texel, vec3 displacement) {
    return Corner(imageLoad(positions, texel).xyz, self_relative_motion(displacement, carried_at(texel)));
}
Corner corner_at(ivec2 texel) { return corner_at(texel, imageLoad(displacements, texel).xyz); }

struct Corners {
    ivec2 at;
    uint bits;
    Corner first, right, below, last;
};

Corners corners_of(int place) {
    ivec2 own = texel_of(place);
    vec4 displacement = imageLoad(displacements, own);
    return Corners(own, uint(displacement.w), corner_at(own, displacement.xyz), corner_at(own + ivec2(1, 0)),
                   corner_at(own + ivec2(0, 1)), corner_at(own + ivec2(1, 1)));
}

/// A cell without triangles may lie past the last column or row of its cloth and lack corners; its normal is zero.
vec3 normal_of(Corners of) {
    return self_cell_normal((of.bits & 3u) != 0u, of.first.at, of.right.at, of.below.at, of.last.at);
}

SelfBox box_of(Corner corner, vec3 axis) { return self_slab(corner.at, corner.motion, axis); }

Cell cell_of(Corners of, vec3 axis) {
    SelfBox first = box_of(of.first, axis), right = box_of(of.right, axis), below = box_of(of.below, axis),
            last = box_of(of.last, axis);
    SelfBox diagonal = self_slabs_joined(right, below);
    return Cell(of.at, of.bits, first, self_slabs_joined(first, diagonal), self_slabs_joined(last, diagonal),
                self_slabs_joined(first, right), self_slabs_joined(first, below), diagonal);
}

uint meets(SelfBox one, SelfBox other, float thickness) {
    return self_primitives_meet(one, other, push, thickness) ? 1u : 0u;
}

/// Returns bits of the existing triangles of a cell that another cell's first particle may meet.
uint triangles_met(Cell one, Cell other, float thickness) {
    uint bits = meets(one.particle, other.upper, thickness) | (meets(one.particle, other.lower, thickness) << 1);
    return (one.bits & self_particle_exists) != 0u ? bits & other.bits & 3u : 0u;
}

/// Returns bits of the existing edges of a cell that edge k of another cell may meet.
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

void list_points(int entry, uint bits) {
    uint count = uint(bitCount(bits)), place = 0u;
    if (count > 0u) place = place_after(atomicAdd(record[0].near_point_count, count), count);
    for (int k = 0; k < self_first_edge_pair; ++k) {
        bool listed = (bits & (1u << k)) != 0u;
        if (listed && place < uint(push.near_capacity)) near[place] = self_near_entry(entry, k);
        place += listed ? 1u : 0u;
    }
}

void list_edges(int entry, uint bits) {
    uint count = uint(bitCount(bits)), place = 0u;
    if (count > 0u) place = place_after(atomicAdd(record[0].near_edge_count, count), count);
    for (;;) {
        int k = findLSB(bits);
        if (k >= 0 && place < uint(push.near_capacity))
            near[uint(push.near_capacity) - 1u - place] = self_near_entry(entry, k);
        ++place;
        bits &= max(bits, 1u) - 1u;
        if (bits == 0u) break;
    }
}

bool still_cross(int one, int other) {
    uint meeting = meetings[owner_of(one) * push.cloth_count + owner_of(other)];
    return meeting >= self_meets_apart && crossings[max(meeting, self_meets_apart) - self_meets_apart].count > 0;
}

void judge(int entry) {
    ivec2 pair = cells[entry];
    Corners first = corners_of(pair.x), second = corners_of(pair.y);
    vec3 axis = normal_of(first);
    Cell one = cell_of(first, axis), other = cell_of(second, axis);
    uint bits = met(one, other, self_mean_thickness(cloth_at(one.at), cloth_at(other.at)));
    if (crossed) bits = still_cross(pair.x, pair.y) ? 0u : bits;
    list_points(entry, bits & ((1u << self_first_edge_pair) - 1u));
    list_edges(entry, bits >> self_first_edge_pair);
}

void main() {
    load_carried();
    int count = self_listed(record[0].cell_count, push.cell_capacity);
    FOR_EVERY(i, count, judge(i))
    FOR_FOUND(place, push.grid.x * push.grid.y, is_left(place), clear(place))
    FOR_EVERY(entry, self_listed(borne[0].corners.x, push.touching_capacity), chain(entry))
    dispatch(self_size_pairs, reached);
}
