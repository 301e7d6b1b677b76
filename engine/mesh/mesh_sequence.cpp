#include "mesh/mesh_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "mesh/mesh_error.h"

namespace drape {

namespace {

/// The start and end of a frame, for the motion and for the picture.
constexpr std::size_t kept_forms = 4;
constexpr std::size_t no_vertex = std::numeric_limits<std::size_t>::max();

/// Returns the poses of a form's own vertices, each of which is one or several of those given.
std::vector<float> welded(const std::vector<std::uint32_t>& places, std::size_t vertices, const std::vector<float>& xyz,
                          double tolerance) {
    const std::size_t points = places.size(), count = points == 0 ? 0 : xyz.size() / (3 * points);
    std::vector<std::size_t> first(vertices, no_vertex);
    for (std::size_t point = points; point-- > 0;) first[places[point]] = point;
    std::vector<float> result(3 * vertices * count);
    for (std::size_t pose = 0; pose < count; ++pose) {
        const float* const from = xyz.data() + 3 * points * pose;
        for (std::size_t point = 0; point < points; ++point) {
            const std::size_t one = first[places[point]];
            for (std::size_t k = 0; k < 3; ++k) {
                if (!(std::abs(from[3 * point + k] - from[3 * one + k]) <= tolerance))
                    throw MeshError(
                        fmt::format("expected vertices in one place of the mesh to stay together, {} and {} "
                                    "part in pose {}",
                                    one, point, pose));
                result[3 * (vertices * pose + places[point]) + k] = from[3 * one + k];
            }
        }
    }
    return result;
}

}  // namespace

MeshSequence::MeshSequence(const MeshShape& form, const std::vector<std::uint32_t>& places,
                           const std::vector<float>& xyz)
    : vertices_(form.vertices().size()),
      xyz_(welded(places, vertices_, xyz, form.mending().welded > 0 ? form.mending().tolerance : 0)) {
    count_ = xyz_.size() / (3 * vertices_);
    if (count_ == 0) throw MeshError("expected a pose, got none");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (std::size_t pose = 0; pose < count_; ++pose)
        for (const Triangle& triangle : form.triangles())
            for (const std::uint32_t corner : triangle)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double x = xyz_[3 * (vertices_ * pose + corner) + axis];
                    lower[axis] = std::min(lower[axis], x);
                    upper[axis] = std::max(upper[axis], x);
                }
    std::vector<Vec3> vertices;
    for (std::size_t k = 0; k < vertices_; ++k) vertices.push_back(place(k, 0));
    form_ = std::make_shared<const MeshShape>(form, std::move(vertices), lower, upper);
    if (form.shell() == 0) expect_body(form);
}

void MeshSequence::expect_body(const MeshShape& form) const {
    const double least = 1e-6 * form.volume();
    for (std::size_t pose = 0; pose < count_; ++pose) {
        double six = 0;
        const auto at = [&](std::uint32_t corner) { return place(corner, static_cast<double>(pose)); };
        for (const auto& [a, b, c] : form.triangles()) six += dot(at(a), cross(at(b), at(c)));
        if (!(six / 6 > least))
            throw MeshError(
                fmt::format("expected poses in which the surface bounds a body as in the mesh, in pose {} it "
                            "{}",
                            pose, six / 6 < -least ? "is inside out" : "bounds nothing"));
    }
}

Vec3 MeshSequence::place(std::size_t vertex, double pose) const {
    const double whole = std::floor(pose), share = pose - whole;
    const auto before = static_cast<std::size_t>(whole) % count_, after = (before + 1) % count_;
    const float* const from = xyz_.data() + 3 * (vertices_ * before + vertex);
    const float* const to = xyz_.data() + 3 * (vertices_ * after + vertex);
    Vec3 at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = share > 0 ? from[k] + share * (double{to[k]} - from[k]) : from[k];
    return at;
}

std::shared_ptr<const MeshShape> MeshSequence::at(double pose) const {
    const std::lock_guard lock(mutex_);
    for (const auto& [number, known] : recent_)
        if (number == pose) return known;
    std::vector<Vec3> vertices;
    vertices.reserve(vertices_);
    for (std::size_t k = 0; k < vertices_; ++k) vertices.push_back(place(k, pose));
    recent_.emplace_back(pose, std::make_shared<const MeshShape>(*form_, std::move(vertices)));
    if (recent_.size() > kept_forms) recent_.pop_front();
    return recent_.back().second;
}

double MeshSequence::farthest(double from, double to) const {
    double most = 0;
    for (std::size_t k = 0; from != to && k < vertices_; ++k) {
        const Vec3 way = minus(place(k, to), place(k, from));
        most = std::max(most, dot(way, way));
    }
    return std::sqrt(most);
}

double MeshSequence::farthest_off_middle(double before, double between, double after) const {
    double most = 0;
    for (std::size_t k = 0; k < vertices_; ++k) {
        const Vec3 off = minus(times(0.5, plus(place(k, before), place(k, after))), place(k, between));
        most = std::max(most, dot(off, off));
    }
    return std::sqrt(most);
}

}  // namespace drape
