// A tree of boxes over triangles, to find the triangle nearest to a point, and those that a line along x passes
// through.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "drape/vec3.h"
#include "shared/form_types.h"

namespace drape {

/// Numbers of three vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Where a line along x passes through a surface.
struct LinePassage {
    double x;  ///< m
    int turn;  ///< 1: into what the surface bounds, as x grows; -1: out of it
    std::uint32_t triangle;
};

/// Returns the share of all directions in which a strip is seen from a point: the strip from the edge from `a` to `b`
/// along x to infinity, positive where the triangle of a, b and that end turns counter-clockwise as seen from the
/// outside. It jumps by 1 where the point passes through the strip, by the arithmetic of `passages`.
double strip_winding(const Vec3& a, const Vec3& b, const Vec3& at);

/// The vertices and triangles must outlive it.
class TriangleTree {
  public:
    TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

    /// Returns the distance to the nearest triangle, m. `nearest` is a guess, whose distance is taken first, and then
    /// that triangle; points beside each other take turns fast. What is farther than `exact_within` may be told up to 2
    /// % too far: where much is as near, that spares most of the work.
    double distance(const Vec3& point, double exact_within, std::uint32_t& nearest) const;

    /// Appends the tree in the form that passes use; it has the same number of boxes for equally many triangles.
    void append_to(std::vector<glsl::FormNode>& nodes) const;

    /// Appends where the line through (y, z) along x passes, in no order. Of two triangles at an edge that it meets it
    /// passes exactly one: the side of a line is decided by the same arithmetic for both, and a tie by the order of
    /// the edge's vertices.
    void passages(double y, double z, std::vector<LinePassage>& found) const;

  private:
    struct Node {
        Vec3 lower, upper;
        std::uint32_t first, count;  ///< triangles of a leaf; count 0: `first` is the second child, the first follows
    };
    struct Item;

    std::uint32_t build(std::span<Item> items);
    std::uint32_t append_to(std::vector<glsl::FormNode>& nodes, std::uint32_t index) const;
    double triangle_distance(std::uint32_t triangle, const Vec3& point) const;

    std::span<const Vec3> vertices_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace drape
