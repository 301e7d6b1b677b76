#include "mesh/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/vectors.h"
#include "mesh/mesh_error.h"

namespace drape {

namespace {

constexpr std::size_t inner_points = 22;

}  // namespace

MeshShape::MeshShape(const std::vector<Vec3>& vertices, std::vector<Triangle> triangles, std::optional<double> shell,
                     std::vector<std::uint32_t>* places, Solid solid)
    : triangles_(std::move(triangles)), shell_(shell.value_or(0)) {
    std::vector<std::uint32_t> welded;
    weld(vertices, &welded);
    if (triangles_.empty()) throw MeshError("expected triangles with an area, got none");
    center();
    if (!shell) make_body(solid, welded);
    tree_.emplace(vertices_, triangles_);
    if (!shell) expect_an_inside();
    find_inner_radius();
    if (places) *places = std::move(welded);
}

MeshShape::MeshShape(const MeshShape& form, std::vector<Vec3> vertices, const Vec3& lower, const Vec3& upper)
    : vertices_(std::move(vertices)),
      triangles_(form.triangles_),
      middle_(times(0.5, plus(lower, upper))),
      half_extents_(times(0.5, minus(upper, lower))),
      shell_(form.shell_),
      inner_radius_(form.inner_radius_),
      mending_(form.mending_) {
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
      inner_radius_(form.inner_radius_),
      mending_(form.mending_) {
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
    *places = std::move(welded);
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
    for (double& extent : half_extents_) extent += 0.5 * shell_;
    for (Vec3& vertex : vertices_) vertex = minus(vertex, middle_);
}

void MeshShape::make_body(Solid solid, std::vector<std::uint32_t>& places) {
    Surface surface{std::move(vertices_), std::move(triangles_)};
    mending_ = mend(surface, solid, middle_, places);
    vertices_ = std::move(surface.vertices);
    triangles_ = std::move(surface.triangles);
    if (triangles_.empty()) throw MeshError("expected triangles with an area, got none");
    const double box = 8 * half_extents_[0] * half_extents_[1] * half_extents_[2];
    if (mending_.rim.empty() && !(std::abs(volume()) > 1e-9 * box))
        throw MeshError(
            "expected a surface that bounds a body, got one that bounds nothing: give \"shell\", its "
            "thickness in metres, if it is to be a thin wall");
}

/// Calls `see(first, step, count)` for lines of points in the bounding box.
template <class See>
void MeshShape::at_inner_points(const See& see) const {
    const auto at = [&](std::size_t axis, std::size_t k) {
        return half_extents_[axis] * ((2 * static_cast<double>(k) + 1) / inner_points - 1);
    };
    for (std::size_t z = 0; z < inner_points; ++z)
        for (std::size_t y = 0; y < inner_points; ++y)
            see({at(0, 0), at(1, y), at(2, z)}, 2 * half_extents_[0] / inner_points, inner_points);
}

void MeshShape::expect_an_inside() const {
    if (mending_.rim.empty()) return;
    std::size_t inside = 0, unclear = 0;
    at_inner_points([&](const Vec3& first, double step, std::size_t count) {
        for (const double turns : winding(first, step, count)) {
            inside += std::abs(turns) > 0.5;
            unclear += std::abs(turns) > 0.25 && std::abs(turns) < 0.75;
        }
    });
    if (inside > 0 && 20 * unclear <= inside) return;
    throw too_open(mending_.rim.size(), plus(middle_, vertices_[mending_.rim[0][0]]));
}

void MeshShape::find_inner_radius() {
    inner_radius_ = 0.5 * shell_;
    if (shell_ > 0) return;
    std::vector<double> row(inner_points);
    at_inner_points([&](const Vec3& first, double step, std::size_t) {
        distances(first, step, 0, row);
        inner_radius_ = std::max(inner_radius_, -std::ranges::min(row));
    });
}

double MeshShape::distance(const Vec3& local) const {
    std::vector<double> one(1);
    distances(local, 0, std::numeric_limits<double>::infinity(), one);
    return one.front();
}

std::vector<double> MeshShape::winding(const Vec3& first, double step, std::size_t count) const {
    std::vector<double> all(count);
    std::vector<LinePassage> passages;
    tree_->passages(first[1], first[2], passages);
    std::ranges::sort(passages, {}, &LinePassage::x);
    int turns = 0;
    std::size_t next = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = first[0] + static_cast<double>(k) * step;
        while (next < passages.size() && passages[next].x < x) turns += passages[next++].turn;
        all[k] = turns;
        // Strips from the open edges along x to infinity close the surface, and no line along x passes through them.
        for (const auto& [from, to] : mending_.rim)
            all[k] -= strip_winding(vertices_[to], vertices_[from], {x, first[1], first[2]});
    }
    return all;
}

std::vector<bool> MeshShape::inside(const Vec3& first, double step, std::size_t count) const {
    std::vector<bool> all(count);
    if (shell_ > 0) return all;
    const std::vector<double> turns = winding(first, step, count);
    for (std::size_t k = 0; k < count; ++k) all[k] = std::abs(turns[k]) > 0.5;
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
