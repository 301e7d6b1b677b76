// Lists the pairs of primitives that this substep may bring together, of the cells that were found near each other: of
// each what its first particle owns.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) buffer Pairs { uvec4 pairs[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };

/// Corners of a cell, its first particle the first, and their motions.
struct Cell {
    ivec2 at;
    SelfCloth cloth;
    vec3 x0, x1, x2, x3;
    vec3 moved0, moved1, moved2, moved3;
    uint edges;      // bit k: edge k exists
    uint triangles;  // bits 1 and 2
};

vec3 moved_at(ivec2 texel) {
    return self_relative_motion(imageLoad(displacements, texel).xyz, record[0].carried.xyz);
}

vec3 at(ivec2 texel) { return imageLoad(positions, texel).xyz; }

Cell cell_of(int index) {
    ivec2 own = texel_of(index);
    ivec2 right = own + ivec2(1, 0), below = own + ivec2(0, 1), across = own + ivec2(1, 1);
    vec4 displacement = imageLoad(displacements, own);
    uint bits = uint(displacement.w);
    return Cell(own, cloth_at(own), at(own), at(right), at(below), at(across),
                self_relative_motion(displacement.xyz, record[0].carried.xyz), moved_at(right), moved_at(below),
                moved_at(across), bits >> 2, bits & 3u);
}

bool listed(bool edges, SelfCorners x, SelfCorners motions, float kept, float thickness) {
    return self_listed_pair(edges, self_gap(edges, x), motions, kept, thickness);
}

/// Bits of the triangles of a cell that a particle may meet.
uint near_triangles(Cell one, Cell other) {
    float thickness = self_mean_thickness(one.cloth, other.cloth);
    bool meets_upper =
        listed(false, SelfCorners(one.x0, other.x0, other.x1, other.x2),
               SelfCorners(one.moved0, other.moved0, other.moved1, other.moved2), thickness, thickness);
    bool meets_lower =
        listed(false, SelfCorners(one.x0, other.x1, other.x3, other.x2),
               SelfCorners(one.moved0, other.moved1, other.moved3, other.moved2), thickness, thickness);
    return ((meets_upper ? 1u : 0u) | (meets_lower ? 2u : 0u)) & other.triangles;
}

struct Edge {
    vec3 a, b;
    vec3 moved_a, moved_b;
};
Edge along(Cell cell) { return Edge(cell.x0, cell.x1, cell.moved0, cell.moved1); }
Edge across(Cell cell) { return Edge(cell.x0, cell.x2, cell.moved0, cell.moved2); }
Edge diagonal(Cell cell) { return Edge(cell.x1, cell.x2, cell.moved1, cell.moved2); }

uint near_edge(Edge one, Edge other, float thickness) {
    SelfCorners motions = SelfCorners(one.moved_a, one.moved_b, other.moved_a, other.moved_b);
    return listed(true, SelfCorners(one.a, one.b, other.a, other.b), motions, thickness, thickness) ? 1u : 0u;
}

/// Bits of the existing edges of a cell that one that exists may meet.
uint near_edges_of(Edge one, Cell other, float thickness) {
    uint bits = near_edge(one, along(other), thickness) | (near_edge(one, across(other), thickness) << 1) |
                (near_edge(one, diagonal(other), thickness) << 2);
    return bits & other.edges;
}

/// Bits of the pairs of edges of two cells that may meet, three for each of the first.
uint near_edges(Cell one, Cell other) {
    float thickness = self_mean_thickness(one.cloth, other.cloth);
    uint first = (one.edges & 1u) != 0u ? near_edges_of(along(one), other, thickness) : 0u;
    uint second = (one.edges & 2u) != 0u ? near_edges_of(across(one), other, thickness) : 0u;
    uint third = (one.edges & 4u) != 0u ? near_edges_of(diagonal(one), other, thickness) : 0u;
    return first | (second << 3) | (third << 6);
}

vec3 where(uint corner) { return at(self_texel(corner)); }
vec3 moved(uint corner) { return moved_at(self_texel(corner)); }

/// Lists a pair unless it shares a corner, or the thickness that it keeps is less than what it was found with.
void add_pair(bool edges, uvec4 pair) {
    if (self_shares_corner(edges, pair)) return;
    SelfCloth one = cloth_at(self_texel(pair.x)), other = cloth_at(self_texel(pair.w));
    float kept = self_pair_thickness(one, other, edges, self_texel(pair.x), self_texel(pair.y), self_texel(pair.z),
                                     self_texel(pair.w));
    SelfCorners x = SelfCorners(where(pair.x), where(pair.y), where(pair.z), where(pair.w));
    SelfCorners motions = SelfCorners(moved(pair.x), moved(pair.y), moved(pair.z), moved(pair.w));
    if (!listed(edges, x, motions, kept, self_mean_thickness(one, other))) return;
    uint place = atomicAdd(record[0].pair_count, 1u);
    if (place < uint(push.pair_room)) pairs[place] = uvec4(edges ? pair.x | self_edge_pair : pair.x, pair.yzw);
}

/// Corners of pair k of two cells (0..3: particle and triangle, 4..12: edges).
uvec4 pair_of(ivec2 a, ivec2 b, int k) {
    if (k < 4) {
        ivec2 particle = k < 2 ? a : b, cell = k < 2 ? b : a;
        int which = (k & 1) + 1;
        return uvec4(self_corner(particle), self_corner(cell + triangle_corner(which, 0)),
                     self_corner(cell + triangle_corner(which, 1)), self_corner(cell + triangle_corner(which, 2)));
    }
    ivec4 one = self_edge((k - 4) / 3), other = self_edge((k - 4) % 3);
    return uvec4(self_corner(a + ivec2(one.x, one.y)), self_corner(a + ivec2(one.z, one.w)),
                 self_corner(b + ivec2(other.x, other.y)), self_corner(b + ivec2(other.z, other.w)));
}

void main() {
    int count = self_listed(record[0].cell_count, push.cell_room);
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    for (int i = int(gl_GlobalInvocationID.x); i < count; i += stride) {
        ivec2 pair = cells[i];
        Cell one = cell_of(pair.x), other = cell_of(pair.y);
        // One of a cell with itself is all: the others are the same, or share a corner.
        uint near = near_triangles(one, other);
        if (pair.x != pair.y) near |= (near_triangles(other, one) << 2) | (near_edges(one, other) << 4);
        while (near != 0u) {
            int k = findLSB(near);
            near &= near - 1u;
            add_pair(k >= 4, pair_of(one.at, other.at, k));
        }
    }
}
