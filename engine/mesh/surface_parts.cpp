#include "mesh/surface_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "base/vectors.h"
#include "mesh/mesh_error.h"

namespace drape {

namespace {

double box_volume(const Vec3& lower, const Vec3& upper) {
    return (upper[0] - lower[0]) * (upper[1] - lower[1]) * (upper[2] - lower[2]);
}

/// A triangle's neighbours: at each of its edges at most one that has it in common with no other.
struct Neighbours {
    std::array<std::uint32_t, 3> triangles{};
    std::array<bool, 3> alike{};  ///< they go along their common edge in opposite directions, as they should
    std::uint32_t count = 0;

    void add(std::uint32_t triangle, bool is_alike) {
        triangles[count] = triangle;
        alike[count++] = is_alike;
    }
};

std::vector<Neighbours> neighbours(const SurfaceEdges& edges, std::size_t triangles) {
    std::vector<Neighbours> beside(triangles);
    edges.each([&](std::span<const SurfaceEdges::Use> uses) {
        if (uses.size() != 2) return;
        const bool alike = uses[0].forward != uses[1].forward;
        beside[uses[0].triangle].add(uses[1].triangle, alike);
        beside[uses[1].triangle].add(uses[0].triangle, alike);
    });
    return beside;
}

}  // namespace

std::pair<Vec3, Vec3> bounds(const Surface& surface, const std::vector<Triangle>& triangles) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (const Triangle& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                lower[axis] = std::min(lower[axis], surface.vertices[corner][axis]);
                upper[axis] = std::max(upper[axis], surface.vertices[corner][axis]);
            }
    return {lower, upper};
}

double area(const Surface& surface) {
    double sum = 0;
    for (const auto& [a, b, c] : surface.triangles)
        sum += 0.5 * length(cross(minus(surface.vertices[b], surface.vertices[a]),
                                  minus(surface.vertices[c], surface.vertices[a])));
    return sum;
}

double volume(const Surface& surface, const std::vector<Triangle>& triangles) {
    const auto [lower, upper] = bounds(surface, triangles);
    const Vec3 middle = times(0.5, plus(lower, upper));
    const auto arm = [&](std::uint32_t corner) { return minus(surface.vertices[corner], middle); };
    double six = 0;
    for (const auto& [a, b, c] : triangles) six += dot(arm(a), cross(arm(b), arm(c)));
    return six / 6;
}

bool bounds_nothing(const Surface& surface) {
    const auto [lower, upper] = bounds(surface, surface.triangles);
    return !(std::abs(volume(surface, surface.triangles)) > 1e-9 * box_volume(lower, upper));
}

double winding_number(const Surface& surface, const std::vector<Triangle>& triangles, const Vec3& at) {
    double sum = 0;
    for (const Triangle& triangle : triangles) {
        const Vec3 a = minus(surface.vertices[triangle[0]], at), b = minus(surface.vertices[triangle[1]], at),
                   c = minus(surface.vertices[triangle[2]], at);
        const double la = length(a), lb = length(b), lc = length(c);
        sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (4 * std::numbers::pi);
}

SurfaceParts::SurfaceParts(Surface& surface, const Vec3& origin)
    : surface_(surface),
      origin_(origin),
      edges_(surface.triangles),
      turned_(surface.triangles.size(), -1),
      part_of_(surface.triangles.size()) {
    const std::vector<Neighbours> beside = neighbours(edges_, surface.triangles.size());
    for (std::uint32_t first = 0; first < turned_.size(); ++first) {
        if (turned_[first] >= 0) continue;
        const auto number = static_cast<std::uint32_t>(parts_.size());
        Part& part = parts_.emplace_back();
        turned_[first] = 0;
        part.triangles.push_back(first);
        for (std::size_t k = 0; k < part.triangles.size(); ++k) {
            const std::uint32_t here = part.triangles[k];
            part_of_[here] = number;
            for (std::uint32_t side = 0; side < beside[here].count; ++side) {
                const std::uint32_t next = beside[here].triangles[side];
                if (turned_[next] >= 0) continue;
                turned_[next] = static_cast<signed char>(beside[here].alike[side] ? turned_[here] : 1 - turned_[here]);
                part.triangles.push_back(next);
            }
        }
        const auto against = std::ranges::count_if(part.triangles, [&](std::uint32_t k) { return is_turned(k); });
        if (2 * static_cast<std::size_t>(against) > part.triangles.size())
            for (const std::uint32_t k : part.triangles) turned_[k] = static_cast<signed char>(1 - turned_[k]);
    }
    gather();
}

/// Finds what the parts bound. One that is open may be judged where its openings are at most a quarter of its area, by
/// the sum of its triangles' areas as vectors, which is none for a closed one.
void SurfaceParts::gather() {
    for (Part& part : parts_) {
        std::ranges::sort(part.triangles);
        const std::vector<Triangle> triangles = triangles_of(part);
        std::tie(part.lower, part.upper) = bounds(surface_, triangles);
        part.volume = drape::volume(surface_, triangles);
        part.least = 1e-9 * box_volume(part.lower, part.upper);
        Vec3 opening{};
        double whole = 0;
        for (const auto& [a, b, c] : triangles) {
            const Vec3 twice = cross(minus(surface_.vertices[b], surface_.vertices[a]),
                                     minus(surface_.vertices[c], surface_.vertices[a]));
            opening = plus(opening, twice);
            whole += length(twice);
        }
        part.bounds = length(opening) <= 0.25 * whole;
    }
}

std::vector<Triangle> SurfaceParts::triangles_of(const Part& part) const {
    std::vector<Triangle> triangles;
    for (const std::uint32_t k : part.triangles) {
        Triangle& triangle = triangles.emplace_back(surface_.triangles[k]);
        if (is_turned(k) != part.turned) std::swap(triangle[1], triangle[2]);
    }
    return triangles;
}

void SurfaceParts::expect_one_way() const {
    std::size_t count = 0;
    Vec3 where{};
    edges_.each([&](std::span<const SurfaceEdges::Use> uses) {
        if (uses.size() != 2) return;
        const bool alike = uses[0].forward != uses[1].forward;
        if (alike == (turned_[uses[0].triangle] == turned_[uses[1].triangle])) return;
        if (count++ == 0)
            where = times(0.5, plus(surface_.vertices[uses[0].edge.first], surface_.vertices[uses[0].edge.second]));
    });
    if (count == 0) return;
    where = plus(where, origin_);
    throw MeshError(
        fmt::format("expected triangles that all turn one way seen from outside, got {} edges at which two cannot be "
                    "made to, one at ({:.6g}, {:.6g}, {:.6g}) m: the surface has one side",
                    count, where[0], where[1], where[2]));
}

double SurfaceParts::volume() const {
    double sum = 0;
    for (const Part& part : parts_)
        if (part.bounds) sum += part.volume;
    return sum;
}

void SurfaceParts::turn_all() {
    for (Part& part : parts_) {
        part.turned = !part.turned;
        part.volume = -part.volume;
    }
}

bool SurfaceParts::is_in_cavity(const Part& part, const TriangleTree& tree) const {
    const Vec3& at = surface_.vertices[surface_.triangles[part.triangles[0]][0]];
    // A line along x meets the parts around.
    std::vector<LinePassage> passages;
    tree.passages(at[1], at[2], passages);
    std::set<std::uint32_t> met;
    for (const LinePassage& passage : passages) met.insert(part_of_[passage.triangle]);
    std::size_t around = 0;
    for (const std::uint32_t number : met) {
        const Part& other = parts_[number];
        bool holds = &other != &part;
        for (std::size_t axis = 0; axis < 3; ++axis)
            holds = holds && other.lower[axis] < part.lower[axis] && part.upper[axis] < other.upper[axis];
        if (holds && std::abs(winding_number(surface_, triangles_of(other), at)) > 0.5) ++around;
    }
    return around % 2 != 0;
}

void SurfaceParts::turn_outwards() {
    const auto is_inside_out = [](const Part& part) { return part.bounds && part.volume < -part.least; };
    if (std::ranges::none_of(parts_, is_inside_out)) return;
    const TriangleTree tree(surface_.vertices, surface_.triangles);
    for (Part& part : parts_)
        if (is_inside_out(part) && !is_in_cavity(part, tree)) {
            part.turned = !part.turned;
            part.volume = -part.volume;
        }
}

bool SurfaceParts::is_closed() const {
    bool closed = true;
    edges_.each([&](std::span<const SurfaceEdges::Use> uses) {
        int net = 0;
        for (const SurfaceEdges::Use& use : uses) {
            const bool turned = is_turned(use.triangle) != parts_[part_of_[use.triangle]].turned;
            net += use.forward != turned ? 1 : -1;
        }
        closed = closed && net == 0;
    });
    return closed;
}

std::size_t SurfaceParts::turned_triangles() const { return static_cast<std::size_t>(std::ranges::count(turned_, 1)); }

std::size_t SurfaceParts::turned_parts() const {
    return static_cast<std::size_t>(std::ranges::count(parts_, true, &Part::turned));
}

void SurfaceParts::apply() {
    for (const Part& part : parts_)
        for (const std::uint32_t k : part.triangles)
            if (is_turned(k) != part.turned) std::swap(surface_.triangles[k][1], surface_.triangles[k][2]);
}

}  // namespace drape
