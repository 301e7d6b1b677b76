// Corners of the pairs of a particle and a triangle or of two edges, and which of those pairs two cells have.
#ifndef DRAPE_SELF_ELEMENTS_H
#define DRAPE_SELF_ELEMENTS_H

#include "include/triangles.h"
#include "include/vector.h"

/// A corner in a pair: row and column.
SHARED uint self_corner(ivec2 texel) { return (uint(texel.y) << 16) | uint(texel.x); }
SHARED ivec2 self_texel(uint corner) { return ivec2(int(corner & 0xffffu), int(corner >> 16)); }

/// The chain of a pair among those of its first corner's place.
SHARED int self_chain(uvec4 pair) { return int((pair.z & 1u) | ((pair.z >> 15) & 2u)); }

/// Returns whether the two primitives of a pair have a corner in common.
SHARED bool self_shares_corner(bool edges, uvec4 pair) {
    bool one = pair.x == pair.z || pair.x == pair.w || pair.y == pair.z || pair.y == pair.w;
    return edges ? one : pair.x == pair.y || pair.x == pair.z || pair.x == pair.w;
}

/// Corners of the pair of a particle and triangle `which` (1, 2) of a cell.
SHARED uvec4 self_point_pair(ivec2 particle, ivec2 cell, int which) {
    ivec2 b = triangle_corner(which, 0), c = triangle_corner(which, 1), d = triangle_corner(which, 2);
    return uvec4(self_corner(particle), self_corner(ivec2(cell.x + b.x, cell.y + b.y)),
                 self_corner(ivec2(cell.x + c.x, cell.y + c.y)), self_corner(ivec2(cell.x + d.x, cell.y + d.y)));
}

/// Bits of the pairs of primitives of two cells: 0 and 1 are the first one's particle and the other's triangles, 2 and
/// 3 the other way round, and from 4 on edges, three of the other for each of the first.
const int self_first_edge_pair = 4;
/// Bits of the pairs that share no corner and do not belong to another pair of cells too. `columns`, `rows`: from the
/// first cell to the other.
SHARED uint self_disjoint(int columns, int rows) {
    uint beside = columns == 0 ? 0x0002u : columns == 1 ? 0x13c3u : 0x1fffu;
    uint below = columns == 0 ? 0x1273u : columns == 1 ? 0x1ff7u : columns == -1 ? 0x097fu : 0x1fffu;
    return rows == 0 ? beside : rows == 1 ? below : 0x1fffu;
}

/// An entry of the list of near primitives: index in the list of cells, and which of the cells' pairs of particles and
/// triangles, or of edges.
SHARED uint self_near_entry(int cells, int kind) { return (uint(cells) << 4) | uint(kind); }
SHARED int self_near_cells(uint entry) { return int(entry >> 4); }
SHARED int self_near_kind(uint entry) { return int(entry & 15u); }
/// Divides the number of a pair of edges by 3.
SHARED int self_first_edge(int kind) { return (kind * 11) >> 5; }

/// Edge k (0..2) that a particle owns: its ends relative to the particle.
SHARED ivec4 self_edge(int k) { return ivec4(k == 2 ? 1 : 0, 0, k == 0 ? 1 : 0, k == 0 ? 0 : 1); }

/// Corners of the pair of edges i of one particle and k of another.
SHARED uvec4 self_edge_pair(ivec2 a, int i, ivec2 b, int k) {
    ivec4 one = self_edge(i), other = self_edge(k);
    return uvec4(self_corner(ivec2(a.x + one.x, a.y + one.y)), self_corner(ivec2(a.x + one.z, a.y + one.w)),
                 self_corner(ivec2(b.x + other.x, b.y + other.y)), self_corner(ivec2(b.x + other.z, b.y + other.w)));
}

/// The two triangles that edge k may belong to: cell relative to the particle, and which one.
SHARED ivec4 self_edge_owner(int k, int side) {
    if (k == 2) return ivec4(0, 0, side == 0 ? 1 : 2, 0);
    if (side == 0) return ivec4(0, 0, 1, 0);
    return k == 0 ? ivec4(0, -1, 2, 0) : ivec4(-1, 0, 2, 0);
}

#endif
