#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/vectors.h"

namespace drape {

namespace {

constexpr std::size_t most_in_a_leaf = glsl::most_leaf_triangles;
/// The tree is halved by numbers, so it is at most this deep.
constexpr std::size_t deepest_level = 64;

Vec3 along(const Vec3& a, const Vec3& way, double share) { return plus(a, times(share, way)); }

/// Returns the point of triangle abc nearest to p, by the region of the plane that p lies over (Ericson, "Real-Time
/// Collision Detection", 5.1.5).
Vec3 nearest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vec3 bp = minus(p, b);
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, ab, d1 / (d1 - d3));
    const Vec3 cp = minus(p, c);
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, ac, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, minus(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double all = va + vb + vc;
    if (!(all > 0)) return a;  // the triangle has no area, and its edges were not nearer
    return along(along(a, ab, vb / all), ac, vc / all);
}

double squared_distance(const Vec3& p, const Vec3& lower, const Vec3& upper) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double beyond = std::max({lower[axis] - p[axis], p[axis] - upper[axis], 0.0});
        sum += beyond * beyond;
    }
    return sum;
}

/// Returns 1 or -1: on which side of the line from a to b, projected along x, a point lies. The vertices are taken in
/// the order of their coordinates, so that both triangles at an edge see the same number with opposite signs.
int side_of(const Vec3& a, const Vec3& b, double y, double z) {
    const bool swapped = std::pair(b[1], b[2]) < std::pair(a[1], a[2]);
    const Vec3 &first = swapped ? b : a, &second = swapped ? a : b;
    const double side = (second[1] - first[1]) * (z - first[2]) - (second[2] - first[2]) * (y - first[1]);
    const int sign = side >= 0 ? 1 : -1;
    return swapped ? -sign : sign;
}

/// Returns a corner of a box in single precision, rounded outwards.
glsl::vec4 rounded(const Vec3& corner, int side) {
    std::array<float, 3> x{};
    for (std::size_t k = 0; k < 3; ++k) {
        x[k] = static_cast<float>(corner[k]);
        if (side * (corner[k] - x[k]) > 0) x[k] = std::nextafter(x[k], static_cast<float>(side) * 1e30f);
    }
    return {x[0], x[1], x[2], 0};
}

}  // namespace

double strip_winding(const Vec3& a, const Vec3& b, const Vec3& at) {
    const Vec3 to_a = minus(a, at), to_b = minus(b, at);
    const double la = length(to_a), lb = length(to_b);
    if (!(la > 0) || !(lb > 0)) return 0;
    // The formula of van Oosterom and Strackee (1983) with the third corner at infinity.
    const double spanned = std::abs(to_a[1] * to_b[2] - to_a[2] * to_b[1]);
    const double across = la * lb + dot(to_a, to_b) + to_a[0] * lb + to_b[0] * la;
    return side_of(a, b, at[1], at[2]) * std::atan2(spanned, across) / (2 * std::numbers::pi);
}

struct TriangleTree::Item {
    std::uint32_t triangle;
    Vec3 lower, upper, middle;
};

TriangleTree::TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles)
    : vertices_(vertices), triangles_(triangles) {
    std::vector<Item> items;
    items.reserve(triangles.size());
    for (std::uint32_t k = 0; k < triangles.size(); ++k) {
        Item item{k, vertices[triangles[k][0]], vertices[triangles[k][0]], {}};
        for (const std::uint32_t corner : triangles[k])
            for (std::size_t axis = 0; axis < 3; ++axis) {
                item.lower[axis] = std::min(item.lower[axis], vertices[corner][axis]);
                item.upper[axis] = std::max(item.upper[axis], vertices[corner][axis]);
            }
        for (std::size_t axis = 0; axis < 3; ++axis) item.middle[axis] = 0.5 * (item.lower[axis] + item.upper[axis]);
        items.push_back(item);
    }
    order_.reserve(items.size());
    if (!items.empty()) build(items);
}

std::uint32_t TriangleTree::build(std::span<Item> items) {
    const auto own = static_cast<std::uint32_t>(nodes_.size());
    Node node{items[0].lower, items[0].upper, 0, 0};
    for (const Item& item : items)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.lower[axis] = std::min(node.lower[axis], item.lower[axis]);
            node.upper[axis] = std::max(node.upper[axis], item.upper[axis]);
        }
    nodes_.push_back(node);
    if (items.size() <= most_in_a_leaf) {
        nodes_[own].first = static_cast<std::uint32_t>(order_.size());
        nodes_[own].count = static_cast<std::uint32_t>(items.size());
        for (const Item& item : items) order_.push_back(item.triangle);
        return own;
    }
    std::size_t axis = 0;
    for (const std::size_t other : {1, 2})
        if (node.upper[other] - node.lower[other] > node.upper[axis] - node.lower[axis]) axis = other;
    const std::size_t half = items.size() / 2;
    std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half),
                             [axis](const Item& a, const Item& b) {
                                 return std::pair(a.middle[axis], a.triangle) < std::pair(b.middle[axis], b.triangle);
                             });
    build(items.first(half));
    const std::uint32_t second = build(items.subspan(half));
    nodes_[own].first = second;
    return own;
}

double TriangleTree::triangle_distance(std::uint32_t triangle, const Vec3& point) const {
    const auto& [a, b, c] = triangles_[triangle];
    const Vec3 off = minus(point, nearest_point(point, vertices_[a], vertices_[b], vertices_[c]));
    return dot(off, off);
}

/// Appends a box and those below it, and returns the number of the next box.
std::uint32_t TriangleTree::append_to(std::vector<glsl::FormNode>& nodes, std::uint32_t index) const {
    const Node& node = nodes_[index];
    const std::size_t place = nodes.size();
    nodes.push_back({rounded(node.lower, -1), rounded(node.upper, 1), {}, {}});
    std::uint32_t triangles[glsl::most_leaf_triangles];
    for (std::uint32_t k = 0; k < glsl::most_leaf_triangles; ++k)
        triangles[k] = k < node.count ? order_[node.first + k] : glsl::no_triangle;
    nodes[place].triangles = {triangles[0], triangles[1], triangles[2], triangles[3]};
    std::uint32_t behind = index + 1;
    if (node.count == 0) {
        append_to(nodes, index + 1);
        behind = append_to(nodes, node.first);
    }
    nodes[place].links = {behind, 0, 0, 0};
    return behind;
}

void TriangleTree::append_to(std::vector<glsl::FormNode>& nodes) const { append_to(nodes, 0); }

double TriangleTree::distance(const Vec3& point, double exact_within, std::uint32_t& nearest) const {
    constexpr double slack = 1.02 * 1.02;
    double best = triangle_distance(nearest, point);
    std::array<std::pair<double, std::uint32_t>, deepest_level> open;
    std::size_t count = 0;
    open[count++] = {squared_distance(point, nodes_[0].lower, nodes_[0].upper), 0};
    while (count > 0) {
        const auto [far, index] = open[--count];
        if (far >= best || (best > exact_within * exact_within && far * slack >= best)) continue;
        const Node& node = nodes_[index];
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
            if (const double found = triangle_distance(order_[k], point); found < best) {
                best = found;
                nearest = order_[k];
            }
        if (node.count > 0) continue;
        std::pair<double, std::uint32_t> children[2];
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint32_t child = k == 0 ? index + 1 : node.first;
            children[k] = {squared_distance(point, nodes_[child].lower, nodes_[child].upper), child};
        }
        if (children[0].first < children[1].first) std::swap(children[0], children[1]);
        for (const auto& child : children)
            if (child.first < best) open[count++] = child;
    }
    return std::sqrt(best);
}

void TriangleTree::passages(double y, double z, std::vector<LinePassage>& found) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, deepest_level> open;
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = open[--count];
        const Node& node = nodes_[index];
        if (y < node.lower[1] || y > node.upper[1] || z < node.lower[2] || z > node.upper[2]) continue;
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            const Triangle& corners = triangles_[order_[k]];
            const Vec3 &a = vertices_[corners[0]], &b = vertices_[corners[1]], &c = vertices_[corners[2]];
            const int side = side_of(a, b, y, z);
            if (side_of(b, c, y, z) != side || side_of(c, a, y, z) != side) continue;
            const Vec3 ab = minus(b, a), ac = minus(c, a);
            const double nx = ab[1] * ac[2] - ab[2] * ac[1];
            if (nx == 0) continue;  // seen from its edge
            const double ny = ab[2] * ac[0] - ab[0] * ac[2], nz = ab[0] * ac[1] - ab[1] * ac[0];
            found.push_back({a[0] - (ny * (y - a[1]) + nz * (z - a[2])) / nx, nx < 0 ? 1 : -1, order_[k]});
        }
        if (node.count > 0) continue;
        open[count++] = index + 1;
        open[count++] = node.first;
    }
}

}  // namespace drape
