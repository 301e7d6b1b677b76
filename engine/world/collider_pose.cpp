#include "world/collider_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "mesh/mesh_sequence.h"
#include "world/motion.h"

namespace drape {
namespace {

std::array<double, 9> product(const std::array<double, 9>& a, const std::array<double, 9>& b) {
    std::array<double, 9> result{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            for (std::size_t k = 0; k < 3; ++k) result[3 * row + column] += a[3 * row + k] * b[3 * k + column];
    return result;
}

ShapeGeometry geometry(const Plane& plane) {
    const Vec3 foot{plane.normal[0] * plane.offset, plane.normal[1] * plane.offset, plane.normal[2] * plane.offset};
    constexpr double none = std::numeric_limits<double>::infinity();
    return {foot, plane.normal, none, none, 0, true};
}
ShapeGeometry geometry(const Sphere& sphere) {
    return {sphere.center, {sphere.radius, 0, 0}, sphere.radius, sphere.radius, sphere.radius, false};
}
ShapeGeometry geometry(const Box& box) {
    const Vec3& h = box.half_extents;
    return {box.center, h, std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]), std::ranges::min(h), 0, true};
}
ShapeGeometry geometry(const Ellipsoid& ellipsoid) {
    const auto [least, most] = std::ranges::minmax(ellipsoid.radii);
    return {ellipsoid.center, ellipsoid.radii, most, least, most, false};
}

ShapeGeometry geometry(const Mesh& mesh) {
    const Vec3& half_extents = mesh.shape->half_extents();
    return {plus(mesh.position, mesh.shape->middle()),
            half_extents,
            length(half_extents),
            mesh.shape->inner_radius() + mesh.grown,
            0,
            false};
}

/// The capsule's own y axis runs from `from` to `to`.
ShapeGeometry geometry(const Capsule& capsule) {
    Vec3 center, y;
    for (std::size_t k = 0; k < 3; ++k) {
        center[k] = 0.5 * (capsule.from[k] + capsule.to[k]);
        y[k] = capsule.to[k] - capsule.from[k];
    }
    const double apart = std::hypot(y[0], y[1], y[2]);
    y = apart > 0 ? Vec3{y[0] / apart, y[1] / apart, y[2] / apart} : Vec3{0, 1, 0};
    // Any x perpendicular to y will do. It is made from the world's x or z axis, whichever is farther from y.
    Vec3 x = std::abs(y[0]) < std::abs(y[2]) ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    const double shared = x[0] * y[0] + x[2] * y[2];
    for (std::size_t k = 0; k < 3; ++k) x[k] -= shared * y[k];
    const double length = std::hypot(x[0], x[1], x[2]);
    for (double& entry : x) entry /= length;
    const Vec3 z{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    const auto [least, most] = std::ranges::minmax(capsule.radii);
    return {center,
            {0.5 * apart, capsule.radii[0], capsule.radii[1]},
            0.5 * apart + most,
            least,
            most,
            false,
            std::array{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}};
}

}  // namespace

ShapeGeometry shape_geometry(const ColliderShape& shape) {
    return std::visit([](const auto& known) { return geometry(known); }, shape);
}

ColliderPose collider_pose(const Collider& collider, double time) {
    const RigidTransform motion = motion_at(collider.path, time);
    const ShapeGeometry shape = shape_geometry(collider.shape);
    ColliderPose pose{product(motion.rotation, rotation_matrix(collider.rotate)), shape.center};
    if (shape.axes) pose.rotation = product(pose.rotation, *shape.axes);
    for (std::size_t axis = 0; axis < 3; ++axis) pose.center[axis] += motion.translation[axis];
    return pose;
}

std::optional<double> reach_along(const Collider& collider, double time, const Vec3& direction) {
    const ColliderPose pose = collider_pose(collider, time);
    const Vec3 size = shape_geometry(collider.shape).size;
    Vec3 d{0, 0, 0};  // in the shape's own axes
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t k = 0; k < 3; ++k) d[k] += pose.rotation[3 * row + k] * direction[row];
    const Vec3 by_axis{size[0] * d[0], size[1] * d[1], size[2] * d[2]};
    const double box = std::abs(by_axis[0]) + std::abs(by_axis[1]) + std::abs(by_axis[2]);
    using Reach = std::optional<double>;
    const Reach own = std::visit(
        ForEachKind{[](const Plane&) { return Reach(); },
                    [&](const Sphere& ball) { return Reach(ball.radius * length(d)); },
                    [&](const Box&) { return Reach(box); }, [&](const Ellipsoid&) { return Reach(length(by_axis)); },
                    [&](const Capsule& rod) {
                        const double half = size[0] * d[1];
                        return Reach(std::max(rod.radii[0] * length(d) - half, rod.radii[1] * length(d) + half));
                    },
                    [&](const Mesh&) { return Reach(box); }},
        collider.shape);
    return own ? Reach(*own + dot(pose.center, direction)) : own;
}

double pose_number(const Mesh& mesh, double time) {
    const auto count = static_cast<double>(mesh.sequence->count());
    const double number = (time - mesh.frames_start) * mesh.frames_per_second;
    if (!mesh.loop) return std::clamp(number, 0.0, count - 1);
    const double within = number - count * std::floor(number / count);
    return within < count ? within : 0;  // rounding may give `count`
}

Collider formed(const Collider& collider, double time) {
    Collider now = collider;
    if (!collider.deforms()) return now;
    Mesh& mesh = std::get<Mesh>(now.shape);
    mesh.shape = mesh.sequence->at(pose_number(mesh, time));
    return now;
}

double deformed(const Collider& collider, double from, double to) {
    if (!collider.deforms()) return 0;
    const Mesh& mesh = std::get<Mesh>(collider.shape);
    return mesh.sequence->farthest(pose_number(mesh, from), pose_number(mesh, to));
}

bool rests(const Collider& collider, double from, double to) {
    if (collider.mass || !rests(collider.path, from, to)) return false;
    if (!collider.deforms()) return true;
    const Mesh& mesh = std::get<Mesh>(collider.shape);
    return mesh.sequence->count() == 1 || (!mesh.loop && pose_number(mesh, from) == pose_number(mesh, to));
}

Vec3 rotate(const std::array<double, 9>& rotation, const Vec3& v) {
    Vec3 result{0, 0, 0};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t k = 0; k < 3; ++k) result[row] += rotation[3 * row + k] * v[k];
    return result;
}

}  // namespace drape
