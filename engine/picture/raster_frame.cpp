#include "picture/raster_frame.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/vectors.h"
#include "cloth/texels.h"
#include "include/tone.h"
#include "picture/camera.h"
#include "picture/ground_shade.h"
#include "picture/picture_places.h"
#include "world/collider_pose.h"
#include "world/up.h"

namespace drape {
namespace {

Vec3 unit_or_up(const Vec3& v) {
    const double size = length(v);
    return size > 0 ? Vec3{v[0] / size, v[1] / size, v[2] / size} : Vec3{0, 1, 0};
}

void write_lights(const SceneDescription& scene, glsl::FrameConstants& constants) {
    for (std::size_t i = 0; i < light_count(scene); ++i) {
        const DirectionalLight& light = scene.lights[i];
        const glsl::vec4 color = linear_color(light.color);
        const auto intensity = static_cast<float>(light.intensity);
        constants.to_light[i] = texel(unit_or_up(sum({0, 0, 0}, light.direction, -1)), 0);
        constants.light_radiance[i] = {color.x * intensity, color.y * intensity, color.z * intensity, 0};
    }
}

/// The rows give (texel x, texel y, depth) in the shadow map from a point of the world.
struct ShadowMatrix {
    std::array<Vec3, 3> axes;
    std::array<double, 3> middle;
    double texel_size;  ///< m
};

Vec3 to_first_light(const SceneDescription& scene) { return unit_or_up(sum({0, 0, 0}, scene.lights[0].direction, -1)); }

ShadowMatrix shadow_matrix(const SceneDescription& scene, const BoundingSphere& extent) {
    const Vec3 to_light = to_first_light(scene);
    const bool is_low = std::abs(to_light[up_axis(scene.up)]) < 0.9;
    const Vec3 across = unit_or_up(cross(in_world(scene.up, is_low ? Vec3{0, 1, 0} : Vec3{0, 0, 1}), to_light));
    const Vec3 up = cross(to_light, across);
    const double texel_size = 2 * extent.radius / glsl::shadow_map_size;
    ShadowMatrix result{{}, {}, texel_size};
    const auto row = [&](std::size_t i, const Vec3& axis, double scale, double middle) {
        result.axes[i] = sum({0, 0, 0}, axis, scale);
        result.middle[i] = middle - scale * dot(axis, extent.center);
    };
    row(0, across, 1 / texel_size, glsl::shadow_map_size / 2.0);
    row(1, up, 1 / texel_size, glsl::shadow_map_size / 2.0);
    // Casters outside the extent would be clipped by depth; four radii each way keep them.
    row(2, to_light, -1 / (8 * extent.radius), 0.5);
    return result;
}

void write_shadow(const SceneDescription& scene, const BoundingSphere& extent, glsl::FrameConstants& constants) {
    if (scene.lights.empty()) return;
    const ShadowMatrix matrix = shadow_matrix(scene, extent);
    constants.ambient.w = static_cast<float>(matrix.texel_size);
    for (std::size_t i = 0; i < 3; ++i) constants.shadow_from_world[i] = texel(matrix.axes[i], matrix.middle[i]);
}

/// Returns the viewing directions, in the world: [0] + x [1] + y [2] at the pixel (x, y).
std::array<Vec3, 3> sight_rays(const PictureGeometry& picture) {
    const Matrix4 view = view_matrix(picture.camera);
    const Matrix4 projection = projection_matrix(picture.camera, picture.width, picture.height);
    const auto axis = [&](std::size_t row) { return Vec3{view[4 * row], view[4 * row + 1], view[4 * row + 2]}; };
    const double x_per_pixel = 2 / (picture.width * projection[0]), y_per_pixel = 2 / (picture.height * projection[5]);
    const Vec3 x = sum({0, 0, 0}, axis(0), x_per_pixel), y = sum({0, 0, 0}, axis(1), y_per_pixel);
    const Vec3 middle = sum({0, 0, 0}, axis(2), -1);
    const Vec3 corner =
        sum(sum(middle, x, -0.5 * picture.width - picture.shift[0]), y, -0.5 * picture.height - picture.shift[1]);
    return {corner, x, y};
}

/// The axes of the floor's coordinates, in the world; y is its normal.
struct FloorFrame {
    Vec3 x, y, z, center;
};

/// Writes Lambert's part of every light by the formula of include/shading.h, for a surface that neither shines nor lets
/// light through.
void write_floor_light(const SceneDescription& scene, const Collider& plane, const Vec3& normal,
                       glsl::FloorConstants& floor) {
    const glsl::vec4 albedo = linear_color(plane.color);
    std::array<Vec3, 2> sums{};  // sums over all lights but the first, and over the first
    const double up = 0.5 + 0.5 * normal[up_axis(scene.up)];
    for (std::size_t k = 0; k < 3; ++k) sums[0][k] = scene.ambient[k] * up + scene.ambient_ground[k] * (1 - up);
    for (std::size_t i = 0; i < light_count(scene); ++i) {
        const DirectionalLight& light = scene.lights[i];
        const double facing = std::max(0.0, -dot(normal, unit_or_up(light.direction)));
        const glsl::vec4 color = linear_color(light.color);
        sums[i == 0] = sum(sums[i == 0], {color.x, color.y, color.z}, light.intensity * facing);
    }
    const auto lit = [&](const Vec3& light) {
        return Vec3{albedo.x * light[0], albedo.y * light[1], albedo.z * light[2]};
    };
    floor.steady = texel(lit(sums[0]), 0);
    floor.first = texel(lit(sums[1]), 0);
}

/// Computes the shadow's place as include/raster_lights.h does for any surface: shifted by a texel, each texel compared
/// with its plane.
void write_floor_shadow(const SceneDescription& scene, const BoundingSphere& extent, const FloorFrame& frame,
                        glsl::FloorConstants& floor) {
    const ShadowMatrix matrix = shadow_matrix(scene, extent);
    const Vec3 to_light = to_first_light(scene);
    const double facing = dot(frame.y, to_light);
    const Vec3 off_surface = sum({0, 0, 0}, frame.y, facing < 0 ? -1 : 1);
    const Vec3 origin = sum(frame.center, sum(off_surface, to_light, 1), matrix.texel_size);
    for (std::size_t i = 0; i < 3; ++i)
        floor.shadow[i] = texel({dot(matrix.axes[i], frame.x), dot(matrix.axes[i], frame.z),
                                 dot(matrix.axes[i], origin) + matrix.middle[i], 0.0});
    const double per_texel = matrix.texel_size / (std::max(std::abs(facing), 0.25) * glsl::shadow_texels_per_depth);
    floor.steady.w = static_cast<float>(per_texel * dot(off_surface, matrix.axes[0]));
    floor.first.w = static_cast<float>(per_texel * dot(off_surface, matrix.axes[1]));
}

/// Lights and shadow must be written before this.
void write_floor(const SceneDescription& scene, const Collider& collider, const PictureGeometry& picture,
                 glsl::FrameConstants& constants) {
    const PlaneExtent extent = plane_extent(picture.camera, picture.extent);
    const ColliderPose pose = plane_pose(collider, 0);
    const auto& r = pose.rotation;
    const Vec3 x{r[0], r[3], r[6]}, normal{r[1], r[4], r[7]}, z{r[2], r[5], r[8]};
    const auto local = [&](const Vec3& v) { return Vec3{dot(x, v), dot(normal, v), dot(z, v)}; };
    glsl::FloorConstants& floor = constants.floor;
    const std::array<Vec3, 3> rays = sight_rays(picture);
    for (std::size_t i = 0; i < rays.size(); ++i) floor.ray[i] = texel(local(rays[i]), 0);
    floor.eye = texel(local(sum(picture.camera.position, pose.center, -1)), extent.line_distance);
    // The floor hides nothing that lies on it, which rounding may put slightly below it.
    constants.above_floor = texel(normal, floor.eye.y * 1e-4 - dot(normal, pose.center));
    floor.fade = texel(local(sum(extent.center, pose.center, -1)), extent.half_side);
    const GroundMap map = ground_map(collider, picture.extent);
    const Vec3 start = map.place(pose.center);
    const double texels = static_cast<double>(glsl::ground_shade_side) / glsl::ground_side;
    floor.shade = texel({texels * start[0], texels * start[1], texels / map.column_side}, 0.0);
    write_floor_light(scene, collider, normal, floor);
    if (!scene.lights.empty()) write_floor_shadow(scene, picture.extent, {x, normal, z, pose.center}, floor);
}

/// Returns whether something holds of a camera wherever it is examined on its way.
bool stays(const Camera& camera, const std::function<bool(const Camera&)>& holds) {
    constexpr int moments = 16;  // from key to key
    bool all = holds(camera_at(camera, 0));
    for (std::size_t k = 0; k + 1 < camera.keys.size(); ++k)
        for (int moment = 0; moment <= moments; ++moment) {
            const double from = camera.keys[k].time, to = camera.keys[k + 1].time;
            all = all && holds(camera_at(camera, from + (to - from) * moment / moments));
        }
    return all;
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
    // Lines are 1, 2 or 5 times a power of ten apart, so that lengths can be read off the picture.
    const double wanted = extent.radius / 2;
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double step = wanted / decade;
    const double line_distance = decade * (step < 2 ? 1 : step < 5 ? 2 : 5);
    return {camera.target, fade_radius(camera, extent), line_distance};
}

std::optional<std::size_t> floor_of(const std::vector<Collider>& colliders, const Camera& camera) {
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider& collider = colliders[i];
        const Plane* plane = special(collider.shape).plane;
        if (!plane || !collider.path.keys.empty()) continue;
        const ColliderPose pose = collider_pose(collider, 0);
        const Vec3 normal = rotate(pose.rotation, plane->normal);
        const auto is_above = [&](const Camera& eye) {
            const double height = dot(normal, sum(eye.position, pose.center, -1));
            // Seen from lower down, its pixels would be computed from too few digits.
            return height > 1e-3 * length(sum(eye.position, eye.target, -1));
        };
        if (stays(camera, is_above)) return i;
    }
    return std::nullopt;
}

glsl::FrameConstants frame_constants(const SceneDescription& scene, const PictureGeometry& picture,
                                     const Collider* floor) {
    const auto& [camera, extent, width, height, shift] = picture;
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
    constants.ground = texel(scene.ambient_ground, scene.up == Up::z ? 1 : 0);
    const glsl::vec4 background = linear_color(scene.image.background);
    constants.background = {glsl::untoned(background.x), glsl::untoned(background.y), glsl::untoned(background.z), 0};
    constants.background.w = static_cast<float>(height);
    constants.fade = texel(camera.target, fade_radius(camera, extent));
    write_lights(scene, constants);
    write_shadow(scene, extent, constants);
    constants.above_floor.w = 1;
    if (floor) write_floor(scene, *floor, picture, constants);
    return constants;
}

FrameView::FrameView(const SceneDescription& scene, const PictureGeometry& picture)
    : picture_(picture), floor_(floor_of(scene.colliders, picture.camera)) {
    light_.up = scene.up;
    light_.lights = scene.lights;
    light_.ambient = scene.ambient;
    light_.ambient_ground = scene.ambient_ground;
    light_.image = scene.image;
    if (floor_) floor_body_ = scene.colliders[*floor_];
    still_ = constants_from(camera_at(0));
}

glsl::FrameConstants FrameView::constants_from(const Camera& camera) const {
    PictureGeometry picture = picture_;
    picture.camera = camera;
    return frame_constants(light_, picture, floor_body_ ? &*floor_body_ : nullptr);
}

glsl::FrameConstants FrameView::constants_at(double time) const {
    return picture_.camera.keys.empty() ? still_ : constants_from(camera_at(time));
}

PlaneExtent FrameView::plane_extent_at(double time) const { return plane_extent(camera_at(time), picture_.extent); }

}  // namespace drape
