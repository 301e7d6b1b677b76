// The corners of pairs, of a particle and a triangle or of two edges, and the pairs that two cells have.
#ifndef DRAPE_SELF_ELEMENTS_H
#define DRAPE_SELF_ELEMENTS_H

#include "include/triangles.h"
#include "include/vector.h"

/// Returns a corner as stored in a pair: row and column.
SHARED uint self_corner(ivec2 texel) { return (uint(texel.y) << 16) | uint(texel.x); }
SHARED ivec2 self_texel(uint corner) { return ivec2(int(corner & 0xffffu), int(corner >> 16)); }

/// Returns the number of the chain that contains a pair, among those of its first corner's place.
SHARED int self_chain(uvec4 pair) { return int((pair.z & 1u) | ((pair.z >> 15) & 2u)); }

/// Returns whether the two primitives of a pair have a corner in common.
SHARED bool self_shares_corner(bool edges, uvec4 pair) {
    bool one = pair.x == pair.z || pair.x == pair.w || pair.y == pair.z || pair.y == pair.w;
    return edges ? one : pair.x == pair.y || pair.x == pair.z || pair.x == pair.w;
}

/// Returns the corners of the pair of a particle and triangle `which` (1, 2) of a cell.
SHARED uvec4 self_point_pair(ivec2 particle, ivec2 cell, int which) {
    ivec2 b = triangle_corner(which, 0), c = triangle_corner(which, 1), d = triangle_corner(which, 2);
    return uvec4(self_corner(particle), self_corner(ivec2(cell.x + b.x, cell.y + b.y)),
                 self_corner(ivec2(cell.x + c.x, cell.y + c.y)), self_corner(ivec2(cell.x + d.x, cell.y + d.y)));
}

/// The bit of a particle that is some triangle's corner, after those of the triangles and edges that it owns.
const uint self_particle_exists = 32u;

/// The bits of the primitive pairs of two cells: 0 and 1 are the first cell's particle with the other's triangles, 2
/// and 3 the other way round; from 4 on come edges, three of the other cell for each of the first.
const int self_first_edge_pair = 4;
/// Returns the bits of the pairs that share no corner and do not also belong to another pair of cells. `columns`,
/// `rows`: from the first cell to the other.
SHARED uint self_disjoint(int columns, int rows) {
    uint beside = columns == 0 ? 0x0002u : columns == 1 ? 0x13c3u : 0x1fffu;
    uint below = columns == 0 ? 0x1273u : columns == 1 ? 0x1ff7u : columns == -1 ? 0x097fu : 0x1fffu;
    return rows == 0 ? beside : rows == 1 ? below : 0x1fffu;
}

/// Returns an entry of the list of near primitives: the index in the list of cells, and which of the cells' pairs of a
/// particle and a triangle, or of edges, it is.
SHARED uint self_near_entry(int cells, int kind) { return (uint(cells) << 4) | uint(kind); }
SHARED int self_near_cells(uint entry) { return int(entry >> 4); }
SHARED int self_near_kind(uint entry) { return int(entry & 15u); }
/// Divides the number of a pair of edges by 3.
SHARED int self_first_edge(int kind) { return (kind * 11) >> 5; }

/// Returns edge k (0..2) that a particle owns: its ends relative to the particle.
SHARED ivec4 self_edge(int k) { return ivec4(k == 2 ? 1 : 0, 0, k == 0 ? 1 : 0, k == 0 ? 0 : 1); }

/// Returns the corners of the pair of edge i of one particle and edge k of another.
SHARED uvec4 self_edge_pair(ivec2 a, int i, ivec2 b, int k) {
    ivec4 one = self_edge(i), other = self_edge(k);
    return uvec4(self_corner(ivec2(a.x + one.x, a.y + one.y)), self_corner(ivec2(a.x + one.z, a.y + one.w)),
                 self_corner(ivec2(b.x + other.x, b.y + other.y)), self_corner(ivec2(b.x + other.z, b.y + other.w)));
}

/// Returns one of the two triangles that edge k may belong to: the cell relative to the particle, and which triangle.
SHARED ivec4 self_edge_owner(int k, int side) {
    if (k == 2) return ivec4(0, 0, side == 0 ? 1 : 2, 0);
    if (side == 0) return ivec4(0, 0, 1, 0);
    return k == 0 ? ivec4(0, -1, 2, 0) : ivec4(-1, 0, 2, 0);
}

/// Returns one of the four cells of whose triangles a particle may be a corner, relative to it, with the bits of those.
const int self_cells_beside = 4;
SHARED ivec4 self_cell_beside(int k) {
    return k == 0 ? ivec4(0, 0, 1, 0) : k == 3 ? ivec4(-1, -1, 2, 0) : ivec4(k == 1 ? -1 : 0, k == 1 ? 0 : -1, 3, 0);
}

#endif
