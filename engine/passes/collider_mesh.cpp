#include "passes/collider_mesh.h"

#include <cmath>

#include "cloth/collider_pose.h"

namespace drape {
namespace {

constexpr std::uint32_t quad_vertex_count = 6;
constexpr std::uint32_t box_vertex_count = 6 * quad_vertex_count;
constexpr std::uint32_t sphere_vertex_count = glsl::sphere_columns * glsl::sphere_rows * quad_vertex_count;
constexpr std::uint32_t backdrop_vertex_count = 3;

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

glsl::vec4 vec4(const Vec3& v, double w) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(w)};
}

glsl::ColliderInstance instance(const ColliderPose& pose, const glsl::vec4& shape, const Vec3& color) {
    const auto& r = pose.rotation;
    return {vec4({r[0], r[1], r[2]}, pose.center[0]), vec4({r[3], r[4], r[5]}, pose.center[1]),
            vec4({r[6], r[7], r[8]}, pose.center[2]), shape, linear_color(color)};
}

/// Unit vector in the plane of which the grid's lines follow: x for a floor.
Vec3 tangent(const Vec3& normal) {
    const Vec3 along = std::abs(normal[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    const double shared = dot(along, normal);
    Vec3 result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = along[i] - shared * normal[i];
    const double length = std::sqrt(dot(result, result));
    for (double& entry : result) entry /= length;
    return result;
}

glsl::ColliderInstance plane_instance(const PlaneCollider& plane, const PlaneExtent& extent, double time) {
    ColliderPose pose = collider_pose(plane, time);
    const Vec3 normal = rotate(pose.rotation, plane.normal);
    const Vec3 x = rotate(pose.rotation, tangent(plane.normal));
    const Vec3 z = cross(x, normal);
    pose.rotation = {x[0], normal[0], z[0], x[1], normal[1], z[1], x[2], normal[2], z[2]};
    const Vec3 to_center{extent.center[0] - pose.center[0], extent.center[1] - pose.center[1],
                         extent.center[2] - pose.center[2]};
    const glsl::vec4 shape{static_cast<float>(extent.half_side), static_cast<float>(extent.line_distance),
                           static_cast<float>(dot(x, to_center)), static_cast<float>(dot(z, to_center))};
    return instance(pose, shape, plane.color);
}

}  // namespace

glsl::vec4 linear_color(const Vec3& srgb) {
    Vec3 linear;
    for (std::size_t i = 0; i < 3; ++i)
        linear[i] = srgb[i] <= 0.04045 ? srgb[i] / 12.92 : std::pow((srgb[i] + 0.055) / 1.055, 2.4);
    return vec4(linear, 1);
}

std::vector<ColliderDraw> collider_draws(const Colliders& colliders) {
    std::vector<ColliderDraw> draws;
    std::uint32_t first = 0;
    const auto add = [&](int kind, std::uint32_t vertex_count, std::size_t count, bool casts_shadow) {
        const auto instance_count = static_cast<std::uint32_t>(count);
        if (count > 0) draws.push_back({kind, vertex_count, first, instance_count, casts_shadow});
        first += instance_count;
    };
    add(glsl::kind_ellipsoid, sphere_vertex_count, colliders.spheres.size() + colliders.ellipsoids.size(), true);
    add(glsl::kind_box, box_vertex_count, colliders.boxes.size(), true);
    add(glsl::kind_plane, quad_vertex_count, colliders.planes.size(), false);
    add(glsl::kind_backdrop, backdrop_vertex_count, 1, false);
    return draws;
}

std::vector<glsl::ColliderInstance> collider_instances(const Colliders& colliders, const PlaneExtent& extent,
                                                       double time) {
    std::vector<glsl::ColliderInstance> instances;
    for (const SphereCollider& sphere : colliders.spheres)
        instances.push_back(instance(collider_pose(sphere, time),
                                     vec4({sphere.radius, sphere.radius, sphere.radius}, 0), sphere.color));
    for (const EllipsoidCollider& ellipsoid : colliders.ellipsoids)
        instances.push_back(instance(collider_pose(ellipsoid, time), vec4(ellipsoid.radii, 0), ellipsoid.color));
    for (const BoxCollider& box : colliders.boxes)
        instances.push_back(instance(collider_pose(box, time), vec4(box.half_extents, 0), box.color));
    for (const PlaneCollider& plane : colliders.planes) instances.push_back(plane_instance(plane, extent, time));
    instances.push_back({});  // the backdrop has no pose
    return instances;
}

}  // namespace drape
