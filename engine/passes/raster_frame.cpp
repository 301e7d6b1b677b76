#include "passes/raster_frame.h"

#include <algorithm>
#include <cmath>

#include "cloth/texels.h"
#include "include/tone.h"
#include "passes/camera.h"
#include "passes/picture_places.h"
#include "scene/vectors.h"

namespace drape {
namespace {

Vec3 unit(const Vec3& v) {
    const double size = length(v);
    return size > 0 ? Vec3{v[0] / size, v[1] / size, v[2] / size} : Vec3{0, 1, 0};
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

double fade_radius(const Camera& camera, const BoundingSphere& extent) {
    const double view = length(sum(camera.target, camera.position, -1));
    return std::max(4 * view, 4 * extent.radius);
}

PlaneExtent plane_extent(const Camera& camera, const BoundingSphere& extent) {
    // 1, 2 or 5 times a power of ten, so that lengths can be read off the picture.
    const double wanted = extent.radius / 2;
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double step = wanted / decade;
    const double line_distance = decade * (step < 2 ? 1 : step < 5 ? 2 : 5);
    return {camera.target, fade_radius(camera, extent), line_distance};
}

glsl::FrameConstants frame_constants(const SceneDescription& scene, const Camera& camera, const BoundingSphere& extent,
                                     std::uint32_t width, std::uint32_t height, const std::array<double, 2>& shift) {
    glsl::FrameConstants constants{};
    Matrix4 matrix = view_projection_matrix(camera, width, height);
    for (std::size_t column = 0; column < 4; ++column) {
        matrix[column] += 2 * shift[0] / width * matrix[12 + column];
        matrix[4 + column] += 2 * shift[1] / height * matrix[12 + column];
    }
    for (std::size_t row = 0; row < 4; ++row)
        constants.clip_from_world[row] =
            texel({matrix[4 * row], matrix[4 * row + 1], matrix[4 * row + 2], matrix[4 * row + 3]});
    constants.eye = texel(camera.position, 0);
    constants.ambient = texel(scene.ambient, 0);
    constants.ground = texel(scene.ambient_ground, 0);
    const glsl::vec4 background = linear_color(scene.image.background);
    constants.background = {glsl::untoned(background.x), glsl::untoned(background.y), glsl::untoned(background.z), 0};
    constants.background.w = static_cast<float>(height);
    constants.fade = texel(camera.target, fade_radius(camera, extent));
    write_lights(scene, constants);
    write_shadow(scene, extent, constants);
    return constants;
}

}  // namespace drape
