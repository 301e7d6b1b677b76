// Makes a body of a surface that is not quite closed, and says what it did.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drape/solid.h"
#include "mesh/mesh_error.h"
#include "mesh/triangle_tree.h"

namespace drape {

/// A hole is closed where its area is at most this share of the surface's.
inline constexpr double small_hole = 0.05;
/// Vertices at open edges are one if they are no farther from each other than this share of the bounding box's
/// diagonal.
inline constexpr double weld_share = 1e-6;

/// A ring of edges beyond which there is no triangle.
struct Hole {
    std::vector<std::uint32_t> ring;  ///< vertices, in the order in which the triangles beside it have them
    double area = 0;                  ///< m^2, of the triangles that close it
};

/// Where edges stay open, another part is within this share of the bounding box's diagonal.
inline constexpr double gap_share = 0.01;

/// What was made of a surface.
struct Mending {
    std::size_t welded = 0;                              ///< vertices that became one with another one
    double tolerance = 0;                                ///< m: how far from each other such vertices may be
    std::size_t doubled = 0;                             ///< triangles left out for another one with the same corners
    std::size_t turned = 0;                              ///< triangles turned over to go the way that their part goes
    std::size_t parts = 0;                               ///< pieces that hang together by edges of two triangles
    std::size_t turned_parts = 0;                        ///< those of them that were turned over as a whole
    std::vector<Hole> closed = {};                       ///< the largest first
    std::vector<std::array<std::uint32_t, 2>> rim = {};  ///< edges that stay open, as their triangles go along them

    /// Returns this as a sentence; empty where nothing was done.
    std::string text() const;
};

/// A surface as a body's.
struct Surface {
    std::vector<Vec3> vertices;  ///< m
    std::vector<Triangle> triangles;
};

/// Mends a surface. Triangles of a part turn the way that most of them do, and then outwards, or inwards where the part
/// bounds a cavity of another one. `places`: becomes the number of the vertex at each one that was given. `origin`: is
/// added to places in messages, m. Throws MeshError, with the place, where the surface has one side or, with
/// Solid::strict, where it is not closed, and where a hole is too large to be closed and no gap between parts. Edges at
/// such gaps stay open, in `rim`.
Mending mend(Surface& surface, Solid solid, const Vec3& origin, std::vector<std::uint32_t>& places);

/// Returns why a surface is refused of which that many edges stay open, one of them at a place, m.
MeshError too_open(std::size_t edges, const Vec3& at);

/// Returns triangles that close a hole, as many as its vertices but two, and sets its area: ears are cut off by the
/// shortest diagonal that lies in it, seen along its mean normal.
std::vector<Triangle> closing(Hole& hole, const std::vector<Vec3>& vertices);

}  // namespace drape
