// Finds which triangles of meshes cross each other: the judge of contact between cloths. It computes in extended
// precision over a tree of bounding boxes and shares no code with the solver. Two triangles cross when an edge of one
// passes through the other's inside. Triangles that share an edge cannot, except by folding flat onto each other; those
// that share a corner are tried with the edges that do not touch it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace drape {

class TriangleCrossings {
  public:
    using Point = std::array<double, 3>;
    using Triangle = std::array<std::uint32_t, 3>;

    struct Mesh {
        std::vector<Point> points;           ///< m
        std::vector<std::uint32_t> indices;  ///< three points per triangle
    };

    explicit TriangleCrossings(const std::vector<Mesh>& meshes) {
        for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
            const auto first = static_cast<std::uint32_t>(points_.size());
            const std::vector<std::uint32_t>& indices = meshes[mesh].indices;
            points_.insert(points_.end(), meshes[mesh].points.begin(), meshes[mesh].points.end());
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
                triangles_.push_back({first + indices[i], first + indices[i + 1], first + indices[i + 2]});
            mesh_.resize(triangles_.size(), mesh);
        }
        order_.resize(triangles_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        if (!order_.empty()) build(0, order_.size());
    }

    /// Counts the pairs of triangles that cross, among the meshes for whose indices `counts` is true.
    template <class Counts>
    std::size_t count(const Counts& counts) const {
        std::size_t crossings = 0;
        for (std::uint32_t triangle = 0; !nodes_.empty() && triangle < triangles_.size(); ++triangle)
            crossings += crossings_of(0, triangle, box_of(triangle), counts);
        return crossings;
    }
    bool any() const {
        for (std::uint32_t triangle = 0; !nodes_.empty() && triangle < triangles_.size(); ++triangle)
            if (crossings_of(0, triangle, box_of(triangle), all) > 0) return true;
        return false;
    }
    /// Returns by point, through all meshes in turn, whether it is a corner of a triangle that crosses another one.
    std::vector<bool> crossed_points() const {
        std::vector<bool> crossed(points_.size());
        for (std::uint32_t triangle = 0; !nodes_.empty() && triangle < triangles_.size(); ++triangle)
            crossings_of(0, triangle, box_of(triangle), all, [&](std::uint32_t other) {
                for (const std::uint32_t each : {triangle, other})
                    for (const std::uint32_t corner : triangles_[each]) crossed[corner] = true;
            });
        return crossed;
    }
    std::size_t count() const {
        return count([](std::size_t, std::size_t) { return true; });
    }

  private:
    struct Box {
        Point lower{1e300, 1e300, 1e300}, upper{-1e300, -1e300, -1e300};
        void add(const Point& p) {
            for (std::size_t k = 0; k < 3; ++k)
                lower[k] = std::min(lower[k], p[k]), upper[k] = std::max(upper[k], p[k]);
        }
        bool meets(const Box& other) const {
            for (std::size_t k = 0; k < 3; ++k)
                if (lower[k] > other.upper[k] || other.lower[k] > upper[k]) return false;
            return true;
        }
    };
    static bool all(std::size_t, std::size_t) { return true; }

    struct Node {
        Box box;
        std::size_t begin, end, left = 0, right = 0;  ///< left is 0 in a leaf
    };
    static constexpr std::size_t leaf_size = 4;

    Box box_of(std::uint32_t triangle) const {
        Box box;
        for (const std::uint32_t corner : triangles_[triangle]) box.add(points_[corner]);
        return box;
    }

    std::size_t build(std::size_t begin, std::size_t end) {
        Node node{{}, begin, end};
        for (std::size_t i = begin; i < end; ++i) {
            const Box box = box_of(order_[i]);
            node.box.add(box.lower), node.box.add(box.upper);
        }
        const std::size_t place = nodes_.size();
        nodes_.push_back(node);
        if (end - begin <= leaf_size) return place;
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (node.box.upper[k] - node.box.lower[k] > node.box.upper[axis] - node.box.lower[axis]) axis = k;
        const std::size_t middle = (begin + end) / 2;
        const auto centre = [&](std::uint32_t triangle) {
            const Triangle& t = triangles_[triangle];
            return points_[t[0]][axis] + points_[t[1]][axis] + points_[t[2]][axis];
        };
        const auto first = order_.begin();
        std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                         first + static_cast<std::ptrdiff_t>(end),
                         [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
        const std::size_t left = build(begin, middle), right = build(middle, end);
        nodes_[place].left = left, nodes_[place].right = right;
        return place;
    }

    template <class Counts>
    std::size_t crossings_of(std::size_t place, std::uint32_t triangle, const Box& box, const Counts& counts) const {
        std::size_t crossings = 0;
        crossings_of(place, triangle, box, counts, [&](std::uint32_t) { ++crossings; });
        return crossings;
    }
    template <class Counts, class See>
    void crossings_of(std::size_t place, std::uint32_t triangle, const Box& box, const Counts& counts,
                      const See& see) const {
        const Node& node = nodes_[place];
        if (!node.box.meets(box)) return;
        if (node.left != 0) {
            crossings_of(node.left, triangle, box, counts, see);
            return crossings_of(node.right, triangle, box, counts, see);
        }
        for (std::size_t i = node.begin; i < node.end; ++i)
            if (order_[i] > triangle && box_of(order_[i]).meets(box) && counts(mesh_[triangle], mesh_[order_[i]]) &&
                cross(triangle, order_[i]))
                see(order_[i]);
    }

    bool cross(std::uint32_t first, std::uint32_t second) const {
        const Triangle &a = triangles_[first], &b = triangles_[second];
        const auto shared = [&](std::uint32_t corner) { return std::ranges::find(b, corner) != b.end(); };
        if (std::ranges::count_if(a, shared) > 1) return false;
        return edges_through(a, b) || edges_through(b, a);
    }

    bool edges_through(const Triangle& edges, const Triangle& wall) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = edges[k], q = edges[(k + 1) % 3];
            const bool touches = std::ranges::find(wall, p) != wall.end() || std::ranges::find(wall, q) != wall.end();
            if (!touches && passes(points_[p], points_[q], wall)) return true;
        }
        return false;
    }

    /// Returns whether the segment from p to q passes through the inside of a triangle.
    bool passes(const Point& p, const Point& q, const Triangle& wall) const {
        const Point &a = points_[wall[0]], &b = points_[wall[1]], &c = points_[wall[2]];
        const long double above = volume(a, b, c, p), below = volume(a, b, c, q);
        if (!((above > 0 && below < 0) || (above < 0 && below > 0))) return false;
        const long double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
        return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
    }

    /// Returns six times the signed volume of a tetrahedron.
    static long double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
        long double u[3], v[3], w[3];
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = static_cast<long double>(b[k]) - a[k];
            v[k] = static_cast<long double>(c[k]) - a[k];
            w[k] = static_cast<long double>(d[k]) - a[k];
        }
        return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
               u[2] * (v[0] * w[1] - v[1] * w[0]);
    }

    std::vector<Point> points_;
    std::vector<Triangle> triangles_;
    std::vector<std::size_t> mesh_;  ///< by triangle
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace drape
