#include "picture/collider_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/vectors.h"
#include "mesh/mesh_shape.h"
#include "world/collider_pose.h"

namespace drape {
namespace {

/// Kinds that may hide most come first, planes last.
constexpr auto drawing_order = [] {
    std::array<int, glsl::collider_kind_count> kinds{};
    for (int kind = 0; kind < glsl::collider_kind_count; ++kind)
        kinds[static_cast<std::size_t>(kind)] = (kind + 1) % glsl::collider_kind_count;
    return kinds;
}();
static_assert(drawing_order.back() == glsl::kind_plane);

glsl::vec4 vec4(const Vec3& v, double w) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(w)};
}

glsl::ColliderInstance instance(const ColliderPose& pose, const glsl::vec4& shape, const Vec3& color) {
    const auto& r = pose.rotation;
    return {vec4({r[0], r[1], r[2]}, pose.center[0]), vec4({r[3], r[4], r[5]}, pose.center[1]),
            vec4({r[6], r[7], r[8]}, pose.center[2]), shape, linear_color(color)};
}

/// Returns a unit vector in the plane that the grid's lines follow: x for a floor.
Vec3 tangent(const Vec3& normal) {
    const Vec3 along = std::abs(normal[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    const double shared = dot(along, normal);
    Vec3 result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = along[i] - shared * normal[i];
    const double length = std::sqrt(dot(result, result));
    for (double& entry : result) entry /= length;
    return result;
}

/// Returns the normals of a mesh's triangles, as long as twice their areas.
std::vector<Vec3> face_normals(const MeshShape& mesh) {
    std::vector<Vec3> normals;
    for (const auto& [a, b, c] : mesh.triangles()) {
        const Vec3& first = mesh.vertices()[a];
        normals.push_back(cross(minus(mesh.vertices()[b], first), minus(mesh.vertices()[c], first)));
    }
    return normals;
}

void append_corners(const MeshShape& mesh, std::vector<glsl::MeshCorner>& corners) {
    const double crease = std::cos(40 * std::numbers::pi / 180);
    const std::vector<Vec3> normals = face_normals(mesh);
    std::vector<std::vector<std::uint32_t>> around(mesh.vertices().size());
    for (std::uint32_t k = 0; k < normals.size(); ++k)
        for (const std::uint32_t corner : mesh.triangles()[k]) around[corner].push_back(k);
    for (std::uint32_t k = 0; k < normals.size(); ++k)
        for (const std::uint32_t corner : mesh.triangles()[k]) {
            Vec3 sum{};
            for (const std::uint32_t other : around[corner])
                if (dot(normals[k], normals[other]) >= crease * length(normals[k]) * length(normals[other]))
                    sum = plus(sum, normals[other]);
            const double size = length(sum);
            corners.push_back({vec4(mesh.vertices()[corner], 1), vec4(size > 0 ? times(1 / size, sum) : sum, 0)});
        }
}

void add_meshes(const std::vector<Collider>& colliders, std::uint32_t instance, std::vector<ColliderDraw>& draws) {
    std::uint32_t vertex = 0;
    for (const Collider& collider : colliders) {
        const Mesh* mesh = special(collider.shape).mesh;
        if (!mesh) continue;
        const auto count = static_cast<std::uint32_t>(3 * mesh->shape->triangles().size());
        draws.push_back({.kind = glsl::kind_mesh,
                         .vertex_count = count,
                         .has_corners = true,
                         .first_vertex = vertex,
                         .first_instance = instance++,
                         .instance_count = 1,
                         .casts_shadow = true,
                         .closed = mesh->shape->shell() == 0});
        vertex += count;
    }
}

glsl::ColliderInstance plane_instance(const Collider& collider, const PlaneExtent& extent, double time) {
    const ColliderPose pose = plane_pose(collider, time);
    const auto& r = pose.rotation;
    const Vec3 x{r[0], r[3], r[6]}, z{r[2], r[5], r[8]};
    const Vec3 to_center{extent.center[0] - pose.center[0], extent.center[1] - pose.center[1],
                         extent.center[2] - pose.center[2]};
    const glsl::vec4 shape{static_cast<float>(extent.half_side), static_cast<float>(extent.line_distance),
                           static_cast<float>(dot(x, to_center)), static_cast<float>(dot(z, to_center))};
    return instance(pose, shape, collider.color);
}

}  // namespace

ColliderPose plane_pose(const Collider& collider, double time) {
    const Plane& plane = std::get<Plane>(collider.shape);
    ColliderPose pose = collider_pose(collider, time);
    const Vec3 normal = rotate(pose.rotation, plane.normal);
    const Vec3 x = rotate(pose.rotation, tangent(plane.normal));
    const Vec3 z = cross(x, normal);
    pose.rotation = {x[0], normal[0], z[0], x[1], normal[1], z[1], x[2], normal[2], z[2]};
    return pose;
}

glsl::vec4 linear_color(const Vec3& srgb) {
    Vec3 linear;
    for (std::size_t i = 0; i < 3; ++i)
        linear[i] = srgb[i] <= 0.04045 ? srgb[i] / 12.92 : std::pow((srgb[i] + 0.055) / 1.055, 2.4);
    return vec4(linear, 1);
}

std::uint32_t round_columns(double radius) {
    constexpr double allowed = 0.1, most = glsl::most_round_columns;
    const double needed = radius > allowed ? std::numbers::pi / std::acos(1 - allowed / radius) : 0;
    return static_cast<std::uint32_t>(std::clamp(4 * std::ceil(needed / 4), 12.0, most));
}

double radius_in_pixels(const Collider& collider, double time, const Camera& camera, std::uint32_t height) {
    const ShapeGeometry shape = shape_geometry(collider.shape);
    if (shape.roundness == 0) return 0;
    const Vec3 center = collider_pose(collider, time).center, eye = camera.position;
    const double nearest = std::hypot(center[0] - eye[0], center[1] - eye[1], center[2] - eye[2]) - shape.reach;
    const double pixels =
        0.5 * height / std::tan(0.5 * camera.fov * std::numbers::pi / 180);  // pixels of what is as long as it is far
    return nearest > 0 ? shape.roundness / nearest * pixels : std::numeric_limits<double>::infinity();
}

std::vector<ColliderDraw> collider_draws(const std::vector<Collider>& colliders, const RoundColumns& columns) {
    std::vector<ColliderDraw> draws;
    std::uint32_t first = 0;
    for (const int kind : drawing_order) {
        const auto count = static_cast<std::uint32_t>(std::ranges::count(colliders, kind, &Collider::kind));
        if (count == 0) continue;
        const SpecialShape shape = special(std::ranges::find(colliders, kind, &Collider::kind)->shape);
        if (shape.mesh) {
            add_meshes(colliders, first, draws);
            first += count;
            continue;
        }
        const std::uint32_t around = columns[static_cast<std::size_t>(kind)];
        const auto vertex_count = static_cast<std::uint32_t>(glsl::mesh_vertex_count(kind, static_cast<int>(around)));
        draws.push_back({.kind = kind,
                         .round_columns = around,
                         .vertex_count = vertex_count,
                         .first_instance = first,
                         .instance_count = count,
                         .casts_shadow = !shape.plane});
        first += count;
    }
    return draws;
}

std::vector<glsl::MeshCorner> mesh_corners(const std::vector<Collider>& colliders, double time) {
    std::vector<glsl::MeshCorner> corners;
    for (const Collider& collider : colliders)
        if (special(collider.shape).mesh) append_corners(*std::get<Mesh>(formed(collider, time).shape).shape, corners);
    return corners;
}

std::vector<glsl::ColliderInstance> collider_instances(const std::vector<Collider>& colliders,
                                                       const PlaneExtent& extent, double time,
                                                       std::span<const std::uint16_t> ids) {
    std::vector<glsl::ColliderInstance> instances;
    for (const int kind : drawing_order)
        for (std::size_t i = 0; i < colliders.size(); ++i) {
            const Collider& collider = colliders[i];
            if (collider.kind() != kind) continue;
            instances.push_back(special(collider.shape).plane
                                    ? plane_instance(collider, extent, time)
                                    : instance(collider_pose(collider, time),
                                               vec4(shape_geometry(collider.shape).size, 0), collider.color));
            if (!ids.empty()) instances.back().color.w = ids[i];
        }
    return instances;
}

}  // namespace drape
