// Cloths that are simulated together are reduced together, each about its own middle.
#include <gtest/gtest.h>

#include "gpu_test.h"
#include "simulation/frame_server.h"
#include "support/sheets.h"

namespace drape {
namespace {

std::vector<ClothStatistics> after_frames(const SceneDescription& scene, std::uint32_t count) {
    const SimulationModel model(scene);
    FrameOptions options;
    options.draw = false;
    options.statistics = true;
    FrameServer server(test::gpu().device, model, options);
    std::vector<ClothStatistics> last;
    server.run(
        count, [=](std::uint32_t frame) { return frame == count; },
        [&](const FinishedFrame& frame) { last = frame.statistics; });
    return last;
}

/// Three cloths; unlike ones have numbers of their own too.
SceneDescription three(SolverMethod method, bool unlike) {
    SceneDescription scene = test::sheet(70, 11, 1, 0.2, 4);
    scene.solver.method = method;
    scene.cloths[0].stiffness = {false, 240, 40, 0};
    for (int k = 1; k < 3; ++k) {
        Cloth cloth = scene.cloths[0];
        cloth.name = "other " + std::to_string(k);
        cloth.placement.origin[2] += 3.0 * k;
        cloth.pins = {test::pin_box(0, 0, static_cast<std::uint32_t>(9 * k), 0)};
        if (unlike) {
            cloth.stiffness = {false, 240.0 + 100 * k, 40.0 / k, 0, 1.0 / k};
            cloth.areal_density *= 1 + k;
            cloth.damping = k;
        }
        scene.cloths.push_back(cloth);
    }
    return scene;
}

void expect_each_ones_own(const SceneDescription& scene) {
    const std::vector<ClothStatistics> together = after_frames(scene, 4);
    ASSERT_EQ(together.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        SceneDescription alone = scene;
        alone.cloths = {scene.cloths[k]};
        const ClothStatistics expected = after_frames(alone, 4).at(0);
        EXPECT_EQ(together[k].center_of_mass, expected.center_of_mass) << k;
        EXPECT_EQ(together[k].mass, expected.mass) << k;
        EXPECT_EQ(together[k].kinetic_energy, expected.kinetic_energy) << k;
        EXPECT_EQ(together[k].elastic_energy, expected.elastic_energy) << k;
        EXPECT_EQ(together[k].stretch_error_rms, expected.stretch_error_rms) << k;
        EXPECT_EQ(together[k].farthest, expected.farthest) << k;
        EXPECT_EQ(together[k].fastest, expected.fastest) << k;
    }
    EXPECT_NE(together[0].kinetic_energy, together[2].kinetic_energy);
}

TEST(StatisticsTest, OfClothsTogetherAreEachOnesOwn) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps})
        for (const bool unlike : {false, true}) expect_each_ones_own(three(method, unlike));
}

/// The lowest row alone has a thickness, another in each cloth, and hangs 0.01 m above a plane.
TEST(StatisticsTest, PenetrationIsUnderTheThicknessThatEachClothsMapGives) {
    SceneDescription scene = three(SolverMethod::line, false);
    scene.colliders = {{Plane{{0, 1, 0}, -0.21}}};
    const float factors[] = {1, 0.5f, 0.25f};
    for (std::size_t k = 0; k < 3; ++k) {
        scene.cloths[k].thickness = 0.08;
        scene.cloths[k].particle_thickness.assign(70 * 11, 0);
        std::fill_n(scene.cloths[k].particle_thickness.end() - 70, 70, factors[k]);
    }
    const std::vector<ClothStatistics> together = after_frames(scene, 0);
    ASSERT_EQ(together.size(), 3u);
    // Of a depth contact takes what coordinates round for none, in the world and in the collider's frame (rounding_at).
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(together[k].penetration.value(), 0.08 * double{factors[k]} - 0.01,
                    1e-6 + 4.8e-7 * together[k].largest_distance)
            << k;
}

}  // namespace
}  // namespace drape
