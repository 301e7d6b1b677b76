// The raster tests share these hand-made cloths, drawn by the raster pass, and the picture that they make.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "base/vectors.h"
#include "gpu_test.h"
#include "graph/executor.h"
#include "graph/plan.h"
#include "picture/camera.h"
#include "picture/layers.h"
#include "picture/raster.h"

namespace drape {

inline constexpr Vec3 black{0, 0, 0}, white{1, 1, 1}, red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};
inline constexpr std::uint32_t width = 320, height = 240;

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Vec3 unit(const Vec3& a) { return (1 / std::sqrt(dot(a, a))) * a; }

inline double linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
/// The tone curve of shaders/include/tone.h, written a second time in double precision: the identity below 0.75, then a
/// shoulder that reaches 1 at 2.5.
inline double toned(double radiance) {
    const double above = (radiance - 0.75) / 0.25, end = 1.75 / 0.25;
    return above > 0 ? 0.75 + 0.25 * above * (1 + above / (end * end)) / (1 + above) : radiance;
}
/// Radiance that is shown as `shown`, by bisection.
inline double radiance_of(double shown) {
    double low = 0, high = 2.5;
    for (int round = 0; round < 50; ++round) (toned(0.5 * (low + high)) < shown ? low : high) = 0.5 * (low + high);
    return high;
}
inline double srgb_byte(double radiance) {
    const double x = std::clamp(toned(radiance), 0.0, 1.0);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

/// Hand-made contents of a cloth's images.
struct DrawnCloth {
    std::uint32_t columns = 2, rows = 2;
    double size_u = 1, size_v = 1, thickness = 0;
    Appearance appearance;
    std::vector<glsl::vec4> positions, normals;
    std::vector<std::uint32_t> indices;
    std::array<double, 2> rest_lengths{0, 0};       ///< m, of springs along columns, rows; 0: no such springs
    std::vector<std::array<double, 2>> panel = {};  ///< Cloth::panel
};

inline Vec3 linear(const Vec3& srgb) { return {linear(srgb[0]), linear(srgb[1]), linear(srgb[2])}; }

inline glsl::vec4 texel(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 1.0f};
}

/// A flat grid around `center`; `u` and `v` are its full edges along columns and rows, `normal` the value of its normal
/// image.
inline DrawnCloth flat_cloth(const Vec3& center, const Vec3& u, const Vec3& v, const Vec3& normal, const Vec3& front,
                             const Vec3& back, std::uint32_t particles = 2) {
    DrawnCloth cloth{
        particles, particles, std::sqrt(dot(u, u)), std::sqrt(dot(v, v)), 0, {front, back, Pattern::plain}, {}, {}, {}};
    for (std::uint32_t row = 0; row < particles; ++row) {
        for (std::uint32_t column = 0; column < particles; ++column) {
            const double s = column / (particles - 1.0) - 0.5, t = row / (particles - 1.0) - 0.5;
            cloth.positions.push_back(texel(center + s * u + t * v));
            cloth.normals.push_back(texel(normal));
        }
    }
    for (std::uint32_t row = 0; row + 1 < particles; ++row) {
        for (std::uint32_t column = 0; column + 1 < particles; ++column) {
            const std::uint32_t p = row * particles + column, below = p + particles;
            cloth.indices.insert(cloth.indices.end(), {p, p + 1, below, p + 1, below + 1, below});
        }
    }
    return cloth;
}

/// A square that faces +z, towards the tests' camera.
inline DrawnCloth square(const Vec3& center, double side, const Vec3& front, const Vec3& back) {
    return flat_cloth(center, {side, 0, 0}, {0, side, 0}, {0, 0, 1}, front, back);
}

struct Picture {
    std::vector<std::uint8_t> bytes;
    std::uint32_t columns = width;
    std::array<int, 3> at(double x, double y) const {
        const auto first =
            4 * (static_cast<std::size_t>(std::floor(y)) * columns + static_cast<std::size_t>(std::floor(x)));
        return {bytes.at(first), bytes.at(first + 1), bytes.at(first + 2)};
    }
    int alpha(const PixelPosition& at) const {
        return bytes.at(4 * (static_cast<std::size_t>(at.y) * columns + static_cast<std::size_t>(at.x)) + 3);
    }
    std::array<int, 3> at(const PixelPosition& position) const { return at(position.x, position.y); }
};

/// The formula of shaders/include/shading.h, written a second time in double precision.
struct Shading {
    Vec3 albedo, normal, to_eye, sky, ground;
    double transmission = 0.2, roughness = 1, sheen = 0.3;
    Vec3 pixel_color(const std::vector<DirectionalLight>& lights) const {
        const double grazing = 1 - std::max(0.0, dot(normal, to_eye));
        Vec3 result;
        for (std::size_t k = 0; k < 3; ++k) {
            const double around = sky[k] * (1 + normal[1]) / 2 + ground[k] * (1 - normal[1]) / 2;
            double radiance = albedo[k] * (around + sky[k] * sheen * std::pow(grazing, 4));
            for (const DirectionalLight& light : lights) {
                const Vec3 to_light = unit(-1.0 * light.direction);
                const double arriving = linear(light.color[k]) * light.intensity;
                const double facing = dot(normal, to_light);
                const Vec3 halfway = unit(to_light + to_eye);
                const double spread = std::pow(roughness, 4), facets = std::pow(std::max(0.0, dot(normal, halfway)), 2);
                const double shine = facing * 0.04 * spread / std::pow(facets * (spread - 1) + 1, 2) /
                                     (4 * std::pow(dot(to_light, halfway), 2));
                radiance += arriving * albedo[k] * (facing > 0 ? facing : transmission * -facing);
                if (&light == lights.data() && facing > 0 && roughness < 1) radiance += arriving * shine;
            }
            result[k] = srgb_byte(radiance);
        }
        return result;
    }
};

inline void expect_color(const std::array<int, 3>& seen, const Vec3& expected, const std::string& what) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], expected[k], 2) << what << ", channel " << k;
}

/// Returns where a point of the world lands in the picture.
inline PixelPosition pixel(const SceneDescription& scene, const Vec3& point) {
    return project(*scene.camera, width, height, point);
}

struct Shot {
    std::uint32_t samples = 1;
    double time = 0;
    RasterOptions options{.shadow = false, .ground_shade = false};
    std::vector<graph::Remark>* skipped = nullptr;
    const vulkan::Device* device = &test::gpu().device;
};

/// The room has a black background, no light, white ambient light, and a camera on the z axis.
inline SceneDescription dark_room() {
    SceneDescription scene;
    scene.camera = Camera{{0, 0, 3}, {0, 0, 0}, 40};
    scene.lights.clear();
    scene.ambient = scene.ambient_ground = white;
    scene.image.background = black;
    return scene;
}

inline Collider painted(const ColliderShape& shape, const Vec3& color) { return {shape, 0.3, {}, {}, color}; }

/// A floor, with a square one metre above it and light straight down.
inline SceneDescription floor_scene() {
    SceneDescription scene = dark_room();
    scene.camera = Camera{{0, 2.5, 3}, {0, 0, 0}, 50};
    scene.ambient = scene.ambient_ground = {0.2, 0.2, 0.2};
    scene.lights = {{{0, -1, 0}, white, 0.6}};
    scene.colliders.push_back(painted(Plane{{0, 1, 0}, 0}, {0.6, 0.6, 0.6}));
    return scene;
}

class Raster : public testing::Test {
  protected:
    Picture draw(SceneDescription scene, const std::vector<DrawnCloth>& cloths, const Shot& shot = {}) {
        return draw_twice(std::move(scene), cloths, shot)[0];
    }

    /// Submits the same plan in both frame slots.
    std::array<Picture, 2> draw_twice(SceneDescription scene, const std::vector<DrawnCloth>& cloths,
                                      const Shot& shot = {}) {
        describe(cloths, scene);
        const RasterPass raster(*shot.device, scene, width, height, shot.samples, shot.options);
        std::array<Picture, 2> pictures;
        run(raster, cloths, shot, [&](const graph::ResourcePool& pool, std::uint32_t slot) {
            const auto mapped = pool.buffer(RasterPass::readback_name, slot).mapped();
            EXPECT_EQ(mapped.size(), raster.readback_byte_count());
            pictures[slot].bytes.resize(raster.readback_byte_count());
            std::memcpy(pictures[slot].bytes.data(), mapped.data(), raster.readback_byte_count());
        });
        return pictures;
    }

    /// Returns the layers, by pixel.
    std::vector<LayerPixel> layers(SceneDescription scene, const std::vector<DrawnCloth>& cloths,
                                   const Shot& shot = {}) {
        describe(cloths, scene);
        const LayerPass pass(*shot.device, scene, width, height, false, false);
        std::array<std::vector<LayerPixel>, 2> both;
        run(pass, cloths, shot, [&](const graph::ResourcePool& pool, std::uint32_t slot) {
            const std::span<const LayerPixel> pixels = pass.pixels(pool, slot);
            both[slot].assign(pixels.begin(), pixels.end());
        });
        EXPECT_EQ(std::memcmp(both[0].data(), both[1].data(), both[0].size() * sizeof(LayerPixel)), 0);
        return both[0];
    }

  private:
    /// Draws in both frame slots; `take` is told of the pool and each of them.
    template <class Pass, class Take>
    static void run(const Pass& pass, const std::vector<DrawnCloth>& cloths, const Shot& shot, const Take& take) {
        const vulkan::Device& device = *shot.device;
        graph::Graph graph;
        std::vector<RasterCloth> raster_cloths;
        for (std::size_t i = 0; i < cloths.size(); ++i)
            raster_cloths.push_back(declare(graph, "cloth" + std::to_string(i), cloths[i]));
        pass.add(graph, raster_cloths);
        const graph::Plan plan = graph::make_plan(graph);
        if (shot.skipped) *shot.skipped = plan.skipped;
        const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph, &plan}};
        const graph::ResourcePool pool(device, plans);
        for (std::size_t i = 0; i < cloths.size(); ++i) fill(device, pool, "cloth" + std::to_string(i), cloths[i]);
        pass.upload(pool);
        const graph::RecordedPlan recorded(graph, plan, pool, graph::TimestampMode::none);
        vulkan::FrameSlots slots(device);
        for (std::uint32_t slot = 0; slot < 2; ++slot) {
            pass.write_frame(pool, slot, shot.time);
            slots.submit(slot, recorded.commands(slot));
        }
        for (std::uint32_t slot = 0; slot < 2; ++slot) {
            slots.wait(slot);
            take(pool, slot);
        }
    }

    static void describe(const std::vector<DrawnCloth>& cloths, SceneDescription& scene) {
        scene.cloths.resize(cloths.size());
        for (std::size_t i = 0; i < cloths.size(); ++i) describe(cloths[i], scene.cloths[i]);
    }

    /// Describes a drawn cloth to which the shadow map is fitted.
    static void describe(const DrawnCloth& drawn, Cloth& cloth) {
        const auto at = [&](std::size_t i) {
            return Vec3{drawn.positions[i].x, drawn.positions[i].y, drawn.positions[i].z};
        };
        cloth.size = {drawn.size_u, drawn.size_v};
        cloth.appearance = drawn.appearance;
        cloth.panel = drawn.panel;
        cloth.placement = {at(0), unit(at(drawn.columns - 1) + -1.0 * at(0)),
                           unit(at(drawn.positions.size() - drawn.columns) + -1.0 * at(0))};
    }

    static RasterCloth declare(graph::Graph& graph, const std::string& name, const DrawnCloth& cloth) {
        const auto image = [&](const char* part) {
            return graph.image({name + part, VK_FORMAT_R32G32B32A32_SFLOAT, cloth.columns, cloth.rows,
                                VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::constant});
        };
        return {name,
                cloth.columns,
                cloth.rows,
                cloth.size_u,
                cloth.size_v,
                cloth.thickness,
                cloth.appearance,
                image("/position"),
                image("/normal"),
                graph.buffer<glsl::uint>(name + "/triangles", cloth.indices.size(), graph::Lifetime::constant),
                static_cast<std::uint32_t>(cloth.indices.size()),
                {},
                {},
                cloth.rest_lengths};
    }

    static void fill(const vulkan::Device& device, const graph::ResourcePool& pool, const std::string& name,
                     const DrawnCloth& cloth) {
        vulkan::upload(device, pool.image(name + "/position"), std::as_bytes(std::span(cloth.positions)));
        vulkan::upload(device, pool.image(name + "/normal"), std::as_bytes(std::span(cloth.normals)));
        vulkan::upload(device, pool.buffer(name + "/triangles"), std::as_bytes(std::span(cloth.indices)));
    }
};

}  // namespace drape
