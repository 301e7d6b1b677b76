// Layers are, pixel by pixel, where rays of the camera meet planes and spheres.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "raster_picture.h"

namespace drape {
namespace {

/// The ray through a pixel's centre: its component along the camera's axis is 1, so that its length is the depth.
struct Ray {
    Vec3 eye, direction;
    Vec3 at(double depth) const { return eye + depth * direction; }
};

Ray ray_through(const Camera& camera, std::uint32_t column, std::uint32_t row) {
    const Vec3 forward = unit(camera.target + -1.0 * camera.position);
    const Vec3 across{forward[1] * camera.up[2] - forward[2] * camera.up[1],
                      forward[2] * camera.up[0] - forward[0] * camera.up[2],
                      forward[0] * camera.up[1] - forward[1] * camera.up[0]};
    const Vec3 right = unit(across);
    const Vec3 up{right[1] * forward[2] - right[2] * forward[1], right[2] * forward[0] - right[0] * forward[2],
                  right[0] * forward[1] - right[1] * forward[0]};
    const double per_pixel = 2 * std::tan(camera.fov * std::numbers::pi / 360) / height;
    return {camera.position,
            forward + per_pixel * ((column + 0.5 - width / 2.0) * right + (height / 2.0 - row - 0.5) * up)};
}

double to_plane(const Ray& ray, const Vec3& normal, const Vec3& point) {
    return dot(normal, point + -1.0 * ray.eye) / dot(normal, ray.direction);
}

std::optional<double> to_sphere(const Ray& ray, const Vec3& center, double radius) {
    const Vec3 away = ray.eye + -1.0 * center;
    const double a = dot(ray.direction, ray.direction), b = dot(away, ray.direction);
    const double under = b * b - a * (dot(away, away) - radius * radius);
    if (under < 0) return std::nullopt;
    return (-b - std::sqrt(under)) / a;
}

Vec3 normal_of(const LayerPixel& pixel) {
    return {pixel.normal[0] / 32767.0, pixel.normal[1] / 32767.0, pixel.normal[2] / 32767.0};
}

using Visit = std::function<void(const LayerPixel&, const Ray&)>;
void for_pixels(const std::vector<LayerPixel>& layers, const Camera& camera, const Visit& visit) {
    ASSERT_EQ(layers.size(), std::size_t{width} * height);
    for (std::uint32_t row = 0; row < height; ++row)
        for (std::uint32_t column = 0; column < width; ++column)
            visit(layers[row * width + column], ray_through(camera, column, row));
}

void expect_nothing(const LayerPixel& pixel) {
    EXPECT_TRUE(std::isinf(pixel.depth) && pixel.depth > 0);
    EXPECT_EQ(pixel.normal, (std::array<std::int16_t, 3>{}));
    EXPECT_EQ(pixel.strain, 0);
}

/// A tilted sheet of 1 m x 0.8 m whose springs along columns had 0.8 m, from both sides.
TEST_F(Raster, LayersOfAPlaneClothAreThoseOfItsPlane) {
    SceneDescription scene = dark_room();
    const Vec3 center{0.1, -0.05, 0.4}, u = unit({1, 0.2, 0.5}), v = unit({-0.2, 1, 0});
    const Vec3 normal = unit({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
    DrawnCloth cloth = flat_cloth(center, u, 0.8 * v, normal, white, white);
    cloth.rest_lengths = {0.8, 0};
    for (const double side : {1.0, -1.0}) {
        scene.camera->position = {0.3, 0.4, side * 3};
        std::size_t seen = 0;
        for_pixels(layers(scene, {cloth}), *scene.camera, [&](const LayerPixel& pixel, const Ray& ray) {
            const double depth = to_plane(ray, normal, center);
            const Vec3 away = ray.at(depth) + -1.0 * center;
            const double margin = 0.02, s = 0.5 - std::abs(dot(away, u)), t = 0.4 - std::abs(dot(away, v));
            if (std::min(s, t) < -margin) {
                EXPECT_EQ(pixel.id, 0);
                expect_nothing(pixel);
            }
            if (std::min(s, t) < margin) return;
            ++seen;
            ASSERT_EQ(pixel.id, 1);
            EXPECT_NEAR(pixel.depth, depth, 1e-5 * depth);
            EXPECT_GT(dot(normal_of(pixel), side * normal), 1 - 1e-7);
            EXPECT_NEAR(pixel.strain, 0.25, 1e-5);
        });
        EXPECT_GT(seen, 5000u);
    }
}

/// A floor, a sphere on it and a cloth before that, with the ids of cloths, of planes and of spheres in this order.
TEST_F(Raster, LayersTellClothsAndCollidersApart) {
    SceneDescription scene = floor_scene();
    const Vec3 center{0.2, 0.4, -0.3}, forward{0, 0, 1};
    scene.colliders.push_back(painted(Sphere{center, 0.4}, red));
    const std::vector<DrawnCloth> cloths{square({-1.2, 0.5, 0}, 0.4, white, white),
                                         square({0.1, 0.4, 0.4}, 0.3, white, white)};
    for (const bool alpha : {false, true}) {
        scene.image.alpha = alpha;
        std::array<std::size_t, 5> counts{};
        for_pixels(layers(scene, cloths), *scene.camera, [&](const LayerPixel& pixel, const Ray& ray) {
            ASSERT_LT(pixel.id, counts.size());
            ++counts[pixel.id];
            if (pixel.id == 0) expect_nothing(pixel);
            if (pixel.id == 3) {
                EXPECT_NEAR(pixel.depth, to_plane(ray, {0, 1, 0}, {0, 0, 0}), 2e-5 * static_cast<double>(pixel.depth));
                EXPECT_GT(normal_of(pixel)[1], 1 - 1e-7);
            }
            if (pixel.id == 2) {
                EXPECT_NEAR(pixel.depth, to_plane(ray, forward, {0, 0, 0.4}), 1e-5 * static_cast<double>(pixel.depth));
            }
            const std::optional<double> hit = to_sphere(ray, center, 0.4);
            if (pixel.id != 4 || !hit) return;
            const Vec3 normal = 2.5 * (ray.at(*hit) + -1.0 * center);
            // Along and across, facets are within a tenth of a pixel of the sphere; normals are those of its corners.
            const double facing = dot(normal, unit(-1.0 * ray.direction));
            const double side = *hit * 2 * std::tan(scene.camera->fov * std::numbers::pi / 360) / height;
            if (facing < 0.25) return;
            EXPECT_NEAR(pixel.depth, *hit, 2 * 0.1 * side / facing);
            EXPECT_GT(dot(normal_of(pixel), normal), 0.999);
            EXPECT_EQ(pixel.strain, 0);
        });
        for (const std::size_t id : {1, 2, 4}) EXPECT_GT(counts[id], 300u) << id;
        EXPECT_EQ(counts[3] > 500, !alpha);
        EXPECT_EQ(counts[0] > 0, alpha);  // the floor fills the picture
        // The cloth before the sphere hides it.
        const PixelPosition at = pixel(scene, {0.1, 0.4, 0.4});
        const auto place = static_cast<std::size_t>(at.y) * width + static_cast<std::size_t>(at.x);
        EXPECT_EQ(layers(scene, cloths)[place].id, 2);
    }
}

TEST_F(Raster, LayersShowFixturesAsOneThing) {
    SceneDescription scene = dark_room();
    scene.cloths.resize(1);
    scene.cloths[0].grid = {2, 2};
    scene.cloths[0].pins = {{.particles = {.first = {0, 0}, .last = {0, 0}}}};
    const auto seen = layers(scene, {square({0, 0, 0}, 1, white, white)});
    const PixelPosition at = pixel(scene, {-0.505, -0.505, 0});
    EXPECT_EQ(seen[static_cast<std::size_t>(at.y) * width + static_cast<std::size_t>(at.x)].id, fixture_id);
}

}  // namespace
}  // namespace drape
