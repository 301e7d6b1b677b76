// The explicit micro-step on the device equals its C++ twin bit for bit (lavapipe), over more than 200 substeps.
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;
using test::DeviceRun;
using test::everything;
using test::frame_count;

SceneDescription everything_explicit() {
    SceneDescription scene = everything();
    scene.solver.method = SolverMethod::explicit_steps;
    return scene;
}

TEST(TwinExplicitTest, EverythingAtOnce) { compare(everything_explicit()); }

TEST(TwinExplicitTest, AnOddNumberOfStepsEndsInTheImagesItStartedFrom) {
    SceneDescription scene = everything_explicit();
    scene.solver.substeps = 13;
    compare(scene);
}

TEST(TwinExplicitTest, OneStepPerFrame) {
    SceneDescription scene = everything_explicit();
    scene.solver.substeps = 1;
    compare(scene);
}

TEST(TwinExplicitTest, HolesAndTwoClothsWithoutWind) {
    SceneDescription scene = everything_explicit();
    scene.wind = {};
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 20}, {36, 29}}};
    Cloth second = scene.cloths[0];
    second.name = "second";
    second.grid = {24, 41};
    second.holes.clear();
    second.pins = {test::pin_top(second)};
    second.placement.origin = {-0.4, 0.3, -0.2};
    scene.cloths.push_back(second);
    compare(scene);
}

TEST(TwinExplicitTest, HolesInWind) {
    SceneDescription scene = everything_explicit();
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}};
    compare(scene);
}

TEST(TwinExplicitTest, SoftenedSpringsWithoutShear) {
    SceneDescription scene = everything_explicit();
    scene.cloths[0].stiffness = {false, 1e5, 0, 0};
    scene.solver.strain_damping = 0;
    compare(scene);
}

TEST(TwinExplicitTest, SoftInCompression) {
    SceneDescription scene = everything_explicit();
    scene.cloths[0].stiffness.compression = 0.1;
    compare(scene);
}

TEST(TwinExplicitTest, Bending) {
    SceneDescription scene = everything_explicit();
    scene.cloths[0].stiffness.bend = 1e-4;
    compare(scene);
}

TEST(TwinExplicitTest, SoftenedBendingWithHoles) {
    SceneDescription scene = everything_explicit();
    scene.cloths[0].stiffness.bend = 0.1;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}, {{25, 15}, {26, 16}}};
    compare(scene);
}

TEST(TwinExplicitTest, PlainHangingSheet) {
    SceneDescription scene = test::sheet(65, 33, 1, 0.5, test::substep_count);
    scene.solver.method = SolverMethod::explicit_steps;
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cloths[0].stiffness = {false, 2, 0.2, 0};
    compare(scene);
}

/// Nothing happens between its micro-steps, so that several of them are in flight; columns, rows.
class TwinStreamTest : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};

SceneDescription streaming(std::pair<std::uint32_t, std::uint32_t> grid) {
    SceneDescription scene = test::thrown_sheet(grid, test::substep_count);
    scene.solver.method = SolverMethod::explicit_steps;
    return scene;
}

TEST_P(TwinStreamTest, Plain) { compare(streaming(GetParam())); }

TEST_P(TwinStreamTest, WithoutShearInAnOddNumberOfSteps) {
    SceneDescription scene = streaming(GetParam());
    scene.cloths[0].stiffness = {false, 800, 0, 0};
    scene.solver.substeps = 7;
    compare(scene);
}

TEST_P(TwinStreamTest, WithHoles) {
    SceneDescription scene = streaming(GetParam());
    const auto [columns, rows] = GetParam();
    if (columns < 4) GTEST_SKIP() << "no room for a hole";
    scene.cloths[0].holes = {{{columns / 2, rows / 2}, {columns - 1, rows - 1}}, {{1, 0}, {2, 1}}};
    compare(scene);
}

TEST_P(TwinStreamTest, SoftInCompression) {
    SceneDescription scene = streaming(GetParam());
    scene.cloths[0].stiffness.compression = 0.1;
    compare(scene);
}

TEST_P(TwinStreamTest, WithAPinThatLetsGo) {
    SceneDescription scene = streaming(GetParam());
    Pin released = test::pin_box(0, 1, 0, 1);
    released.release = 0.11;
    scene.cloths[0].pins.push_back(released);
    compare(scene);
}

INSTANTIATE_TEST_SUITE_P(Grids, TwinStreamTest,
                         testing::Values(std::pair(2u, 2u), std::pair(3u, 3u), std::pair(17u, 33u), std::pair(40u, 3u),
                                         std::pair(41u, 5u), std::pair(65u, 64u), std::pair(129u, 40u),
                                         std::pair(5u, 257u), std::pair(45u, 391u)),
                         [](const auto& grid) {
                             return std::to_string(grid.param.first) + "x" + std::to_string(grid.param.second);
                         });

TEST(TwinExplicitTest, ExactSkipsChangeNoBit) {
    const SceneDescription scene = everything_explicit();
    const SimulationModel lean(scene), full(scene, {.skip = false});
    DeviceRun skipping(test::gpu().device, lean), keeping(test::gpu().device, full);
    EXPECT_FALSE(skipping.pool().has("sheet/spring shares"));
    EXPECT_TRUE(keeping.pool().has("sheet/spring shares"));
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        skipping.run_frame(frame);
        keeping.run_frame(frame);
    }
    test::expect_same(Field::position, skipping, keeping, frame_count);
}

TEST(CanaryTest, AMissingBarrierBetweenExplicitStepsIsReported) {
    const SceneDescription scene = everything_explicit();
    const SimulationModel model(scene);
    test::ExpectValidationMessages expected;
    DeviceRun run(test::gpu().device, model, [](const graph::PlannedPass&, const graph::Barrier& barrier) {
        return barrier.reason.find("explicit step") == std::string::npos;
    });
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
