// The picture shows the simulation: marked particles, simulated among the others, are found in the colour image of the
// very run whose position arrays say where they are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "gpu_test.h"
#include "picture/camera.h"
#include "scene_files.h"
#include "simulation/frame_server.h"

namespace drape {
namespace {

constexpr std::uint32_t picture_width = 640, picture_height = 360, last_frame = 40;

/// Markers of a cell beside the scene's own cloths fall, fly and collide with everything else, and shine in pure
/// colours that nothing else has.
struct Marker {
    Vec3 color, origin, v, velocity;
};
const std::array<Marker, 4> markers{{{{1, 0, 0}, {0.05, 1.35, -0.45}, {0, 0, 1}, {0, 0, 0}},
                                     {{0, 0, 1}, {-0.55, 1.35, 0.35}, {0, 0, 1}, {0, 0, 0}},
                                     {{1, 0, 1}, {1.0, 1.1, 0.9}, {0, -1, 0}, {-0.6, 2.9, -0.1}},
                                     {{0, 1, 1}, {-1.3, 1.1, 0.9}, {0, -1, 0}, {0.5, 2.5, 0.2}}}};

/// The four-collider scene without its sheet's own colours: everything but the markers is grey, and the only light is
/// the ambient one.
SceneDescription marked_scene() {
    SceneDescription scene = test::shipped_scene("four_colliders");
    const Vec3 grey{0.5, 0.5, 0.5};
    for (Cloth& cloth : scene.cloths) cloth.appearance = {grey, grey, Pattern::plain};
    for (Collider& collider : scene.colliders) collider.color = grey;
    scene.image.background = grey;
    scene.ambient = scene.ambient_ground = {1, 1, 1};
    scene.lights.clear();
    scene.camera = Camera{.position = {1.3, 2.0, 3.0}, .target = {0, 0.45, 0}, .fov = 36};  // sees all their flights
    scene.cloths[0].placement.origin[1] = 1.0;  // under the markers that fall
    for (std::size_t i = 0; i < markers.size(); ++i) {
        Cloth marker = scene.cloths[0];
        marker.name = fmt::format("marker {}", i);
        marker.grid = {3, 2};
        marker.size = {0.05, 0.025};
        marker.holes.clear();
        marker.thickness = 0.05;  // so that it rests above the sheet, which keeps less distance
        marker.velocity = markers[i].velocity;
        marker.stiffness.rigid = true;
        marker.placement = {markers[i].origin, {1, 0, 0}, markers[i].v};
        marker.appearance = {markers[i].color, markers[i].color, Pattern::plain};
        scene.cloths.push_back(marker);
    }
    return scene;
}

struct Center {
    double x = 0, y = 0;
};

/// Centre of the pixels of a pure colour, weighted by how much of it each holds; nothing when there are none.
std::optional<Center> find(const std::span<const std::uint8_t> rgba, const Vec3& color) {
    double x = 0, y = 0, sum = 0;
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        double least_wanted = 255, most_other = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double value = rgba[4 * i + k];
            if (color[k] > 0)
                least_wanted = std::min(least_wanted, value);
            else
                most_other = std::max(most_other, value);
        }
        const double share = least_wanted - most_other;
        if (share < 24) continue;
        x += share * (static_cast<double>(i % picture_width) + 0.5);
        y += share * (static_cast<double>(i / picture_width) + 0.5);
        sum += share;
    }
    if (sum == 0) return std::nullopt;
    return Center{x / sum, y / sum};
}

/// Centre of a marker in the picture, the mean of its triangles' centres by their area there.
Center projected(const SceneDescription& scene, const std::span<const float> positions) {
    Center center;
    double sum = 0;
    const auto at = [&](std::size_t particle) {
        const Vec3 x{positions[4 * particle], positions[4 * particle + 1], positions[4 * particle + 2]};
        return project(*scene.camera, picture_width, picture_height, x);
    };
    for (const std::array<std::size_t, 3>& triangle :
         {std::array<std::size_t, 3>{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}}) {
        const PixelPosition a = at(triangle[0]), b = at(triangle[1]), c = at(triangle[2]);
        const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        center.x += area * (a.x + b.x + c.x) / 3;
        center.y += area * (a.y + b.y + c.y) / 3;
        sum += area;
    }
    return {center.x / sum, center.y / sum};
}

TEST(PictureProjectionTest, MarkedParticlesAreFoundAtTheirPixels) {
    const SceneDescription scene = marked_scene();
    const SimulationModel model(scene);
    FrameOptions options;
    options.positions = true;
    options.width = picture_width;
    options.height = picture_height;
    options.samples = 4;
    FrameServer server(test::gpu().device, model, options);
    double worst = 0;
    std::size_t found_count = 0;
    std::array<Center, markers.size()> first{}, last{};
    server.run(
        last_frame, [](std::uint32_t frame) { return frame % 4 == 0; },
        [&](const FinishedFrame& frame) {
            ASSERT_EQ(frame.positions.size(), 1 + markers.size());
            for (std::size_t i = 0; i < markers.size(); ++i) {
                const Center expected = projected(scene, frame.positions[1 + i]);
                const std::optional<Center> found = find(frame.rgba, markers[i].color);
                ASSERT_TRUE(found) << "marker " << i << ", frame " << frame.frame << " expected at " << expected.x
                                   << " " << expected.y;
                worst = std::max({worst, std::abs(found->x - expected.x), std::abs(found->y - expected.y)});
                EXPECT_NEAR(found->x, expected.x, 1) << "marker " << i << ", frame " << frame.frame;
                EXPECT_NEAR(found->y, expected.y, 1) << "marker " << i << ", frame " << frame.frame;
                if (frame.frame == 0) first[i] = expected;
                last[i] = expected;
                ++found_count;
            }
        });
    EXPECT_EQ(found_count, (last_frame / 4 + 1) * markers.size());
    // The markers moved by far more than the pixel that is allowed.
    for (std::size_t i = 0; i < markers.size(); ++i)
        EXPECT_GT(std::hypot(last[i].x - first[i].x, last[i].y - first[i].y), 20) << "marker " << i;
    std::printf("[ measured ] %zu sightings, at most %.3f pixels off\n", found_count, worst);
}

}  // namespace
}  // namespace drape
