// This checker finds which triangles of meshes cross, exactly, from the bits of single-precision positions alone. It
// judges runs from outside: it shares no code with the simulation, nor with the search for cloths that start through
// each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace drape::test {

using FloatPoint = std::array<float, 3>;

struct FloatMesh {
    std::vector<FloatPoint> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Crossing {
    std::array<std::uint32_t, 2> mesh, triangle;
};

struct Crossings {
    std::vector<Crossing> pairs;  ///< pairs in which an edge of one goes through the other's inside
    std::size_t touching = 0;     ///< pairs that only share points, as a corner on a face, and no corner of the mesh
};

/// Tries all pairs of triangles, of one mesh and of two. Two of a mesh that share a corner cross when the edge across
/// from it goes through the other; those that share an edge cannot.
Crossings find_crossings(const std::vector<FloatMesh>& meshes);

/// Returns the exact sign of a tetrahedron's volume: +1 where d is on the side from which the corners of the triangle a
/// b c go round clockwise, -1 on the other one, 0 in its plane.
int side_of(const FloatPoint& a, const FloatPoint& b, const FloatPoint& c, const FloatPoint& d);

}  // namespace drape::test
