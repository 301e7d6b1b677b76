#include "passes/raster_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth/collider_pose.h"
#include "cloth/texels.h"
#include "passes/camera.h"
#include "scene/vectors.h"

namespace drape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 sum(const Vec3& a, const Vec3& b, double scale = 1) {
    return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}
Vec3 unit(const Vec3& v) {
    const double size = length(v);
    return size > 0 ? Vec3{v[0] / size, v[1] / size, v[2] / size} : Vec3{0, 1, 0};
}

/// Axis-aligned box that grows.
struct Bounds {
    Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    bool empty() const { return !(low[0] <= high[0]); }
    void add(const Vec3& center, double radius) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], center[i] - radius);
            high[i] = std::max(high[i], center[i] + radius);
        }
    }
    void add(const Vec3& center, double radius, const MotionPath& path) {
        if (path.keys.empty()) add(center, radius);
        for (const MotionKey& key : path.keys) add(sum(center, key.translate), radius);
    }
};

void add_cloth(const Cloth& cloth, const std::vector<Collider>& colliders, Bounds& bounds) {
    const double swing = 0.25 * 0.5 * std::hypot(cloth.size[0], cloth.size[1]);
    for (int corner = 0; corner < 4; ++corner) {
        const Vec3 along_u = sum(cloth.placement.origin, cloth.placement.u, corner % 2 == 0 ? 0 : cloth.size[0]);
        const Vec3 point = sum(along_u, cloth.placement.v, corner / 2 == 0 ? 0 : cloth.size[1]);
        bounds.add(point, swing);
        for (const Pin& pin : cloth.pins) bounds.add(point, 0, pin.path);
        for (const Collider& collider : colliders)
            if (const Plane* plane = std::get_if<Plane>(&collider.shape))
                bounds.add(sum(point, plane->normal, plane->offset - dot(point, plane->normal)), swing);
    }
}

void write_lights(const SceneDescription& scene, glsl::FrameConstants& constants) {
    for (std::size_t i = 0; i < light_count(scene); ++i) {
        const DirectionalLight& light = scene.lights[i];
        const glsl::vec4 color = linear_color(light.color);
        const auto intensity = static_cast<float>(light.intensity);
        constants.to_light[i] = texel(unit(sum({0, 0, 0}, light.direction, -1)), 0);
        constants.light_radiance[i] = {color.x * intensity, color.y * intensity, color.z * intensity, 0};
    }
}

void write_shadow(const SceneDescription& scene, const BoundingSphere& extent, glsl::FrameConstants& constants) {
    if (scene.lights.empty()) return;
    const Vec3 to_light = unit(sum({0, 0, 0}, scene.lights[0].direction, -1));
    const Vec3 across = unit(cross(std::abs(to_light[1]) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, to_light));
    const Vec3 up = cross(to_light, across);
    const double texels_per_metre = glsl::shadow_map_size / (2 * extent.radius);
    constants.ambient.w = static_cast<float>(1 / texels_per_metre);
    // Casters outside the extent would be clipped by depth; four radii each way keep them.
    const auto row = [&](const Vec3& axis, double scale, double middle) {
        return texel(sum({0, 0, 0}, axis, scale), middle - scale * dot(axis, extent.center));
    };
    constants.shadow_from_world[0] = row(across, texels_per_metre, glsl::shadow_map_size / 2.0);
    constants.shadow_from_world[1] = row(up, texels_per_metre, glsl::shadow_map_size / 2.0);
    constants.shadow_from_world[2] = row(to_light, -1 / (8 * extent.radius), 0.5);
}

}  // namespace

std::uint32_t light_count(const SceneDescription& scene) {
    return static_cast<std::uint32_t>(std::min<std::size_t>(scene.lights.size(), glsl::light_limit));
}

BoundingSphere scene_extent(const SceneDescription& scene) {
    Bounds bounds;
    for (const Cloth& cloth : scene.cloths) add_cloth(cloth, scene.colliders, bounds);
    for (const Collider& collider : scene.colliders) {
        const ShapeGeometry shape = shape_geometry(collider.shape);
        if (shape.reach < infinity) bounds.add(shape.center, shape.reach, collider.path);
    }
    if (bounds.empty()) {
        const double distance = length(sum(scene.camera.target, scene.camera.position, -1));
        return {scene.camera.target, distance > 0 ? distance : 1.0};
    }
    const Vec3 diagonal = sum(bounds.high, bounds.low, -1);
    return {sum(bounds.low, diagonal, 0.5), std::max(0.5 * length(diagonal), 1e-6)};
}

double fade_radius(const SceneDescription& scene, const BoundingSphere& extent) {
    const double view = length(sum(scene.camera.target, scene.camera.position, -1));
    return std::max(4 * view, 4 * extent.radius);
}

PlaneExtent plane_extent(const SceneDescription& scene, const BoundingSphere& extent) {
    // 1, 2 or 5 times a power of ten, so that lengths can be read off the picture.
    const double wanted = extent.radius / 2;
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double step = wanted / decade;
    const double line_distance = decade * (step < 2 ? 1 : step < 5 ? 2 : 5);
    return {scene.camera.target, fade_radius(scene, extent), line_distance};
}

glsl::FrameConstants frame_constants(const SceneDescription& scene, const BoundingSphere& extent, std::uint32_t width,
                                     std::uint32_t height, const std::array<double, 2>& shift) {
    glsl::FrameConstants constants{};
    Matrix4 matrix = view_projection_matrix(scene.camera, width, height);
    for (std::size_t column = 0; column < 4; ++column) {
        matrix[column] += 2 * shift[0] / width * matrix[12 + column];
        matrix[4 + column] += 2 * shift[1] / height * matrix[12 + column];
    }
    for (std::size_t row = 0; row < 4; ++row)
        constants.clip_from_world[row] =
            texel({matrix[4 * row], matrix[4 * row + 1], matrix[4 * row + 2], matrix[4 * row + 3]});
    constants.eye = texel(scene.camera.position, 0);
    constants.ambient = texel(scene.ambient, 0);
    constants.background = linear_color(scene.image.background);
    constants.background.w = static_cast<float>(height);
    constants.fade = texel(scene.camera.target, fade_radius(scene, extent));
    write_lights(scene, constants);
    write_shadow(scene, extent, constants);
    return constants;
}

}  // namespace drape
