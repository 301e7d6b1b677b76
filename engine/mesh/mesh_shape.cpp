#include "mesh/mesh_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/vectors.h"
#include "mesh/mesh_error.h"

namespace drape {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// How triangles meet at edges.
class Edges {
  public:
    explicit Edges(const std::vector<Triangle>& triangles) {
        uses_.reserve(3 * triangles.size());
        for (std::uint32_t k = 0; k < triangles.size(); ++k)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = triangles[k][corner], b = triangles[k][(corner + 1) % 3];
                uses_.push_back({{std::min(a, b), std::max(a, b)}, k, a < b});
            }
        std::ranges::sort(uses_, {}, &Use::edge);
    }

    struct Use {
        Edge edge;
        std::uint32_t triangle;
        bool forward;
    };
    /// Calls `see(uses)` for every edge with the triangles that have it.
    template <class See>
    void each(const See& see) const {
        for (std::size_t first = 0; first < uses_.size();) {
            std::size_t end = first;
            while (end < uses_.size() && uses_[end].edge == uses_[first].edge) ++end;
            see(std::span(uses_).subspan(first, end - first));
            first = end;
        }
    }

  private:
    std::vector<Use> uses_;
};

struct Closure {
    std::size_t open = 0;    ///< edges of an odd number of triangles
    std::size_t turned = 0;  ///< other edges along which as many triangles do not go one way as the other
    std::size_t many = 0;    ///< edges of more than two triangles
};

Closure closure_of(const std::vector<Triangle>& triangles) {
    Closure closure;
    Edges(triangles).each([&](std::span<const Edges::Use> uses) {
        const auto forward = std::ranges::count(uses, true, &Edges::Use::forward);
        if (uses.size() % 2 != 0)
            ++closure.open;
        else if (2 * static_cast<std::size_t>(forward) != uses.size())
            ++closure.turned;
        if (uses.size() > 2) ++closure.many;
    });
    return closure;
}

/// Turns triangles so that neighbours have the same orientation, as far as possible.
void turn_one_way(std::vector<Triangle>& triangles) {
    struct Neighbour {
        std::uint32_t triangle;
        bool alike;  ///< they traverse their common edge in opposite directions, as they should
    };
    std::vector<std::vector<Neighbour>> beside(triangles.size());
    Edges(triangles).each([&](std::span<const Edges::Use> uses) {
        if (uses.size() != 2) return;
        const bool alike = uses[0].forward != uses[1].forward;
        beside[uses[0].triangle].push_back({uses[1].triangle, alike});
        beside[uses[1].triangle].push_back({uses[0].triangle, alike});
    });
    std::vector<signed char> turned(triangles.size(), -1);
    std::vector<std::uint32_t> open;
    for (std::uint32_t first = 0; first < triangles.size(); ++first) {
        if (turned[first] >= 0) continue;
        turned[first] = 0;
        open.assign(1, first);
        while (!open.empty()) {
            const std::uint32_t here = open.back();
            open.pop_back();
            for (const auto& [next, alike] : beside[here])
                if (turned[next] < 0) {
                    turned[next] = static_cast<signed char>(alike ? turned[here] : 1 - turned[here]);
                    open.push_back(next);
                }
        }
    }
    for (std::size_t k = 0; k < triangles.size(); ++k)
        if (turned[k] == 1) std::swap(triangles[k][1], triangles[k][2]);
}

}  // namespace

MeshShape::MeshShape(const std::vector<Vec3>& vertices, std::vector<Triangle> triangles, std::optional<double> shell,
                     std::vector<std::uint32_t>* places)
    : triangles_(std::move(triangles)) {
    weld(vertices, places);
    if (triangles_.empty()) throw MeshError("expected triangles with an area, got none");
    center();
    close_or_thicken(shell);
    tree_.emplace(vertices_, triangles_);
    find_inner_radius();
}

MeshShape::MeshShape(const MeshShape& form, std::vector<Vec3> vertices, const Vec3& lower, const Vec3& upper)
    : vertices_(std::move(vertices)),
      triangles_(form.triangles_),
      middle_(times(0.5, plus(lower, upper))),
      half_extents_(times(0.5, minus(upper, lower))),
      shell_(form.shell_),
      inner_radius_(form.inner_radius_) {
    for (double& extent : half_extents_) extent += 0.5 * shell_;
    for (Vec3& vertex : vertices_) vertex = minus(vertex, middle_);
    tree_.emplace(vertices_, triangles_);
}

MeshShape::MeshShape(const MeshShape& form, std::vector<Vec3> vertices)
    : vertices_(std::move(vertices)),
      triangles_(form.triangles_),
      middle_(form.middle_),
      half_extents_(form.half_extents_),
      shell_(form.shell_),
      inner_radius_(form.inner_radius_) {
    for (Vec3& vertex : vertices_) vertex = minus(vertex, middle_);
    tree_.emplace(vertices_, triangles_);
}

/// Makes corners in the same place one, and leaves triangles with three different ones.
void MeshShape::weld(const std::vector<Vec3>& given, std::vector<std::uint32_t>* places) {
    std::vector<std::uint32_t> order(given.size()), welded(given.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::sort(
        order, [&](std::uint32_t a, std::uint32_t b) { return std::pair(given[a], a) < std::pair(given[b], b); });
    for (const std::uint32_t k : order) {
        if (vertices_.empty() || vertices_.back() != given[k]) vertices_.push_back(given[k]);
        welded[k] = static_cast<std::uint32_t>(vertices_.size() - 1);
    }
    for (Triangle& triangle : triangles_)
        for (std::uint32_t& corner : triangle) corner = welded[corner];
    std::erase_if(triangles_, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (places) *places = std::move(welded);
}

double MeshShape::volume() const {
    double six = 0;
    for (const Triangle& t : triangles_) six += dot(vertices_[t[0]], cross(vertices_[t[1]], vertices_[t[2]]));
    return six / 6;
}

void MeshShape::center() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (const Triangle& triangle : triangles_)
        for (const std::uint32_t corner : triangle)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                lower[axis] = std::min(lower[axis], vertices_[corner][axis]);
                upper[axis] = std::max(upper[axis], vertices_[corner][axis]);
            }
    middle_ = times(0.5, plus(lower, upper));
    half_extents_ = times(0.5, minus(upper, lower));
    for (Vec3& vertex : vertices_) vertex = minus(vertex, middle_);
}

void MeshShape::close_or_thicken(std::optional<double> shell) {
    if (shell) {
        shell_ = *shell;
        for (double& extent : half_extents_) extent += 0.5 * shell_;
        return;
    }
    Closure closure = closure_of(triangles_);
    if (closure.open > 0)
        throw MeshError(
            fmt::format("expected a closed surface, got one with {} edges of one triangle alone: give "
                        "\"shell\", its thickness in metres, if it is to be a thin wall",
                        closure.open));
    if (closure.turned > 0) {
        turn_one_way(triangles_);
        closure = closure_of(triangles_);
    }
    if (closure.turned > 0)
        throw MeshError(fmt::format(
            "expected triangles that all turn one way seen from outside, got {} edges at which "
            "two cannot be made to: {}",
            closure.turned, closure.many > 0 ? "more than two triangles meet there" : "the surface has one side"));
    const double bounded = volume();
    if (bounded < 0)
        for (Triangle& triangle : triangles_) std::swap(triangle[1], triangle[2]);
    const double box = 8 * half_extents_[0] * half_extents_[1] * half_extents_[2];
    if (!(std::abs(bounded) > 1e-9 * box))
        throw MeshError(
            "expected a surface that bounds a body, got one that bounds nothing: give \"shell\", its "
            "thickness in metres, if it is to be a thin wall");
}

void MeshShape::find_inner_radius() {
    inner_radius_ = 0.5 * shell_;
    if (shell_ > 0) return;
    constexpr std::size_t count = 22;
    std::vector<double> row(count);
    const auto at = [&](std::size_t axis, std::size_t k) {
        return half_extents_[axis] * ((2 * static_cast<double>(k) + 1) / count - 1);
    };
    for (std::size_t z = 0; z < count; ++z)
        for (std::size_t y = 0; y < count; ++y) {
            distances({at(0, 0), at(1, y), at(2, z)}, 2 * half_extents_[0] / count, 0, row);
            inner_radius_ = std::max(inner_radius_, -std::ranges::min(row));
        }
}

double MeshShape::distance(const Vec3& local) const {
    std::vector<double> one(1);
    distances(local, 0, std::numeric_limits<double>::infinity(), one);
    return one.front();
}

std::vector<bool> MeshShape::inside(const Vec3& first, double step, std::size_t count) const {
    std::vector<bool> all(count);
    if (shell_ > 0) return all;
    std::vector<LinePassage> passages;
    tree_->passages(first[1], first[2], passages);
    std::ranges::sort(passages, {}, &LinePassage::x);
    int turns = 0;
    std::size_t next = 0;
    for (std::size_t k = 0; k < count; ++k) {
        while (next < passages.size() && passages[next].x < first[0] + static_cast<double>(k) * step)
            turns += passages[next++].turn;
        all[k] = turns != 0;
    }
    return all;
}

void MeshShape::distances(const Vec3& first, double step, double exact_within, std::vector<double>& row) const {
    std::uint32_t nearest = 0;
    const std::vector<bool> is_inside = inside(first, step, row.size());
    for (std::size_t k = 0; k < row.size(); ++k) {
        row[k] = tree_->distance({first[0] + static_cast<double>(k) * step, first[1], first[2]}, exact_within, nearest);
        row[k] = is_inside[k] ? -row[k] : row[k] - 0.5 * shell_;
    }
}

}  // namespace drape
