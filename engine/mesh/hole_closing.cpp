#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/vectors.h"
#include "mesh/mesh_mending.h"

namespace drape {

namespace {

struct Point {
    double x, y;
};

double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A hole's ring, seen along its mean normal (Newell's), from which ears are cut.
class Ring {
  public:
    Ring(const std::vector<std::uint32_t>& ring, const std::vector<Vec3>& vertices) : vertices_(vertices) {
        // The triangles that close it go the other way along its edges.
        left_.assign(ring.rbegin(), ring.rend());
        Vec3 normal{};
        for (std::size_t k = 0; k < left_.size(); ++k)
            normal = plus(normal, cross(minus(at(k), at(0)), minus(at(after(k)), at(0))));
        const double size = length(normal);
        if (!(size > 0)) normal = {0, 0, 1};
        const Vec3 up = unit_of(normal);
        const Vec3 other = std::abs(up[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 u = unit_of(cross(other, up)), v = cross(up, u);
        for (std::size_t k = 0; k < left_.size(); ++k) {
            const Vec3 arm = minus(at(k), at(0));
            points_.push_back({dot(u, arm), dot(v, arm)});
        }
    }

    std::size_t size() const { return left_.size(); }

    /// Cuts off the ear with the shortest diagonal; where none lies within the ring, the corner that has it.
    Triangle cut() {
        std::vector<std::size_t> order(size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        const auto diagonal = [&](std::size_t k) { return distance(at(before(k)), at(after(k))); };
        std::vector<double> lengths;
        for (std::size_t k = 0; k < size(); ++k) lengths.push_back(diagonal(k));
        const auto later = [&](std::size_t a, std::size_t b) {
            return std::pair(lengths[a], left_[a]) > std::pair(lengths[b], left_[b]);
        };
        std::ranges::make_heap(order, later);
        std::size_t chosen = order.front();
        while (!order.empty()) {
            std::ranges::pop_heap(order, later);
            if (is_ear(order.back())) {
                chosen = order.back();
                break;
            }
            order.pop_back();
        }
        const Triangle ear{left_[before(chosen)], left_[chosen], left_[after(chosen)]};
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(chosen));
        points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(chosen));
        return ear;
    }

  private:
    std::size_t after(std::size_t k) const { return k + 1 < left_.size() ? k + 1 : 0; }
    std::size_t before(std::size_t k) const { return k > 0 ? k - 1 : left_.size() - 1; }
    const Vec3& at(std::size_t k) const { return vertices_[left_[k]]; }

    bool is_ear(std::size_t k) const {
        const Point &a = points_[before(k)], &b = points_[k], &c = points_[after(k)];
        if (!(turn(a, b, c) > 0)) return false;
        for (std::size_t other = 0; other < size(); ++other) {
            if (other == k || other == before(k) || other == after(k)) continue;
            const Point& p = points_[other];
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    const std::vector<Vec3>& vertices_;
    std::vector<std::uint32_t> left_;
    std::vector<Point> points_;
};

}  // namespace

std::vector<Triangle> closing(Hole& hole, const std::vector<Vec3>& vertices) {
    Ring ring(hole.ring, vertices);
    std::vector<Triangle> triangles;
    hole.area = 0;
    while (ring.size() > 2) {
        const auto& [a, b, c] = triangles.emplace_back(ring.cut());
        hole.area += 0.5 * length(cross(minus(vertices[b], vertices[a]), minus(vertices[c], vertices[a])));
    }
    return triangles;
}

}  // namespace drape
