// Finds which triangles of meshes cross each other: the judge of contact between cloths. It computes in extended
// precision over a tree of bounding boxes and shares no code with the solver. Two triangles cross when an edge of one
// passes through the other's inside. Triangles that share an edge cannot, except by folding flat onto each other; those
// that share a corner are tried with the edges that do not touch it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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

    /// `same`: by point of all meshes in turn, the first one that is the same corner; empty: each is one of its own.
    explicit TriangleCrossings(const std::vector<Mesh>& meshes, const std::vector<std::uint32_t>& same = {}) {
        const auto corner = [&](std::uint32_t point) { return same.empty() ? point : same[point]; };
        for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
            const auto first = static_cast<std::uint32_t>(points_.size());
            const std::vector<std::uint32_t>& indices = meshes[mesh].indices;
            points_.insert(points_.end(), meshes[mesh].points.begin(), meshes[mesh].points.end());
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
                triangles_.push_back(
                    {corner(first + indices[i]), corner(first + indices[i + 1]), corner(first + indices[i + 2])});
            mesh_.resize(triangles_.size(), mesh);
        }
        order_.resize(triangles_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        if (!order_.empty()) build(0, order_.size());
    }

    /// Counts the pairs of triangles that cross, among the meshes for whose indices `counts` is true, up to `most`.
    template <class Counts>
    std::size_t count(const Counts& counts, std::size_t most = std::numeric_limits<std::size_t>::max()) const {
        std::size_t crossings = 0;
        for (std::uint32_t triangle = 0; triangle < triangles_.size() && crossings < most; ++triangle)
            look(triangle, [&](std::uint32_t other) {
                const bool counted = other > triangle && counts(mesh_[triangle], mesh_[other]);
                if (counted && cross(triangle, other)) ++crossings;
                return crossings < most;
            });
        return crossings;
    }
    std::size_t count() const {
        return count([](std::size_t, std::size_t) { return true; });
    }
    bool any() const {
        return count([](std::size_t, std::size_t) { return true; }, 1) > 0;
    }
    /// Returns by point, through all meshes in turn, whether it is a corner of a triangle that crosses another one. It
    /// looks for one crossing of each triangle, since all may cross all.
    std::vector<bool> crossed_points() const {
        std::vector<bool> crossed(points_.size());
        for (std::uint32_t triangle = 0; triangle < triangles_.size(); ++triangle) {
            const auto is_crossed = [&](std::uint32_t corner) { return crossed[corner]; };
            if (std::ranges::all_of(triangles_[triangle], is_crossed)) continue;
            look(triangle, [&](std::uint32_t other) {
                if (other == triangle || !cross(triangle, other)) return true;
                for (const std::uint32_t each : {triangle, other})
                    for (const std::uint32_t corner : triangles_[each]) crossed[corner] = true;
                return false;
            });
        }
        return crossed;
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

    /// Shows `see` every triangle whose box meets that of `triangle`, until it returns false.
    template <class See>
    void look(std::uint32_t triangle, const See& see) const {
        look(0, box_of(triangle), see);
    }
    template <class See>
    bool look(std::size_t place, const Box& box, const See& see) const {
        const Node& node = nodes_[place];
        if (!node.box.meets(box)) return true;
        if (node.left != 0) return look(node.left, box, see) && look(node.right, box, see);
        for (std::size_t i = node.begin; i < node.end; ++i)
            if (box_of(order_[i]).meets(box) && !see(order_[i])) return false;
        return true;
    }

    bool cross(std::uint32_t first, std::uint32_t second) const {
        const Triangle &a = triangles_[first], &b = triangles_[second];
        const auto shared = [&](std::uint32_t corner) { return std::ranges::find(b, corner) != b.end(); };
        if (std::ranges::count_if(a, shared) > 1) return false;
        return edges_through(a, b) || edges_through(b, a);
    }

    /// Returns whether an edge of one triangle, of those that do not touch a corner of the other, passes through it.
    bool edges_through(const Triangle& edges, const Triangle& wall) const {
        const Point &a = points_[wall[0]], &b = points_[wall[1]], &c = points_[wall[2]];
        int side[3];
        for (std::size_t k = 0; k < 3; ++k)
            side[k] = std::ranges::find(wall, edges[k]) != wall.end() ? 0 : side_of(a, b, c, points_[edges[k]]);
        for (std::size_t k = 0; k < 3; ++k)
            if (side[k] * side[(k + 1) % 3] < 0 && passes(points_[edges[k]], points_[edges[(k + 1) % 3]], wall))
                return true;
        return false;
    }

    /// Returns whether the segment from p to q, which are on different sides of a triangle's plane, passes its inside.
    bool passes(const Point& p, const Point& q, const Triangle& wall) const {
        const Point &a = points_[wall[0]], &b = points_[wall[1]], &c = points_[wall[2]];
        const int ab = side_of(p, q, a, b);
        return ab != 0 && side_of(p, q, b, c) == ab && side_of(p, q, c, a) == ab;
    }

    /// Returns the sign of the volume of a tetrahedron. Double precision is asked first: it decides wherever its sum is
    /// above what rounding may have made of it, at most 16 units of the sum of sizes.
    static int side_of(const Point& a, const Point& b, const Point& c, const Point& d) {
        double sizes = 0;
        const double near = volume<double>(a, b, c, d, sizes);
        if (std::abs(near) > 16 * std::numeric_limits<double>::epsilon() * sizes) return near > 0 ? 1 : -1;
        long double exact_sizes = 0;
        const long double exact = volume<long double>(a, b, c, d, exact_sizes);
        return exact > 0 ? 1 : exact < 0 ? -1 : 0;
    }

    /// Returns six times the signed volume of a tetrahedron; `sizes` becomes the sum of its products' sizes.
    template <class Real>
    static Real volume(const Point& a, const Point& b, const Point& c, const Point& d, Real& sizes) {
        Real u[3], v[3], w[3];
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = static_cast<Real>(b[k]) - a[k];
            v[k] = static_cast<Real>(c[k]) - a[k];
            w[k] = static_cast<Real>(d[k]) - a[k];
        }
        Real sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
            sum += u[k] * (v[l] * w[m] - v[m] * w[l]);
            sizes += std::abs(u[k]) * (std::abs(v[l] * w[m]) + std::abs(v[m] * w[l]));
        }
        return sum;
    }

    std::vector<Point> points_;
    std::vector<Triangle> triangles_;
    std::vector<std::size_t> mesh_;  ///< by triangle
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace drape
