// Explicit micro-steps that tiles take several at once, and springs and twist that they sweep, equal the twin's, which
// takes steps and passes one by one (lavapipe).
#include "cloth/kernel_steps.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using Grid2 = std::pair<std::uint32_t, std::uint32_t>;

SceneDescription tiled(Grid2 grid, std::uint32_t substeps) {
    SceneDescription scene = test::thrown_sheet(grid, substeps);
    scene.solver.method = SolverMethod::explicit_steps;
    return scene;
}

/// `counts`: how many micro-steps the passes of a frame must take, in turn, so that the comparison means something.
void compare_tiles(const SceneDescription& scene, const std::vector<std::uint32_t>& counts) {
    std::vector<std::uint32_t> taken;
    for (const Step& step : kernel_steps(SimulationModel(scene), tile_kernels))
        if (step.kind == StepKind::explicit_step) taken.push_back(step.count);
    EXPECT_EQ(taken, counts);
    test::compare(scene, {}, test::gpu().device, {.drawing = true}, tile_kernels);
}

/// `sweeps`: how many of them a frame must have.
void compare_sweeps(const SceneDescription& scene, std::ptrdiff_t sweeps) {
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), tile_kernels);
    EXPECT_EQ(std::ranges::count(steps, StepKind::all_springs, &Step::kind), sweeps);
    const Stiffness& stiffness = scene.cloths[0].stiffness;
    const bool tense = !stiffness.rigid && stiffness.stretch.least() > 0;
    test::compare(scene, {}, test::gpu().device, {.drawing = true, .statistics = tense}, tile_kernels);
}

/// Each suite has grids of one tile with room to spare, filled, one row or column too many, the last that four tiles
/// hold, one more.
std::string name_of(const testing::TestParamInfo<Grid2>& grid) {
    return std::to_string(grid.param.first) + "x" + std::to_string(grid.param.second);
}

class TwinExplicitTileTest : public testing::TestWithParam<Grid2> {};

TEST_P(TwinExplicitTileTest, EvenAndOddSteps) {
    const bool is_whole = GetParam().first <= 16 && GetParam().second <= 16;
    using Counts = std::vector<std::uint32_t>;
    compare_tiles(tiled(GetParam(), 8), is_whole ? Counts{1, 6, 1} : Counts{1, 2, 2, 2, 1});
    compare_tiles(tiled(GetParam(), 5), is_whole ? Counts{1, 3, 1} : Counts{1, 2, 1, 1});
}

INSTANTIATE_TEST_SUITE_P(Grids, TwinExplicitTileTest,
                         testing::Values(Grid2{2, 2}, Grid2{9, 5}, Grid2{16, 16}, Grid2{17, 7}, Grid2{5, 17},
                                         Grid2{24, 24}, Grid2{25, 13}),
                         name_of);

class TwinTileTest : public testing::TestWithParam<Grid2> {};

INSTANTIATE_TEST_SUITE_P(Grids, TwinTileTest,
                         testing::Values(Grid2{2, 2}, Grid2{17, 9}, Grid2{32, 32}, Grid2{33, 7}, Grid2{5, 33},
                                         Grid2{48, 48}, Grid2{49, 25}),
                         name_of);

TEST_P(TwinTileTest, SweepsWithTension) { compare_sweeps(test::thrown_sheet(GetParam(), 5), 5); }

TEST_P(TwinTileTest, RigidSweepsInTwoIterations) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    scene.cloths[0].stiffness.rigid = true;
    scene.solver.iterations = 2;
    compare_sweeps(scene, 10);
}

TEST_P(TwinTileTest, SweepsCarryTensionOverThreeIterations) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    scene.solver.iterations = 3;
    compare_sweeps(scene, 15);
}

TEST_P(TwinTileTest, SweepsWithHolesSoftInCompression) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    const auto [columns, rows] = GetParam();
    if (columns < 4) return;  // no room for a hole
    scene.cloths[0].holes = {{{columns / 2, rows / 2}, {columns - 1, rows - 1}}, {{1, 0}, {2, 1}}};
    scene.cloths[0].stiffness.compression = 0.1;
    compare_sweeps(scene, 5);
}

/// Cells twist.
void compare_twist(SceneDescription scene) {
    scene.cloths[0].stiffness.bend = 1e-3;
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), tile_kernels);
    EXPECT_EQ(std::ranges::count(steps, StepKind::all_twist, &Step::kind), scene.solver.substeps);
    EXPECT_EQ(std::ranges::count(steps, StepKind::twist, &Step::kind), 0);
    test::compare(scene, {}, test::gpu().device, {.drawing = true}, tile_kernels);
}

TEST_P(TwinTileTest, TwistOfLinesInBothOrders) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].pins.pop_back();
    compare_twist(scene);
}

TEST_P(TwinTileTest, TwistOfRelaxationWithHolesInWind) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 3);
    const auto [columns, rows] = GetParam();
    if (columns >= 4) scene.cloths[0].holes = {{{columns / 2, rows / 2}, {columns - 1, rows - 1}}, {{1, 0}, {2, 1}}};
    scene.wind.velocity = {2, 0.5, -1};
    compare_twist(scene);
}

TEST(TwinTileTest, SweepsWithoutShearAndOfShearAlone) {
    SceneDescription scene = test::thrown_sheet({41, 23}, 5);
    scene.cloths[0].stiffness = {false, 800, 0, 0};
    compare_sweeps(scene, 5);
    scene.cloths[0].stiffness = {false, 0, 60, 0};
    compare_sweeps(scene, 5);
}

TEST(TwinTileTest, SweepsAmongWindBendingPinsThatMoveAndColliders) {
    SceneDescription scene = test::everything();
    scene.cloths[0].stiffness.bend = 1e-3;
    compare_sweeps(scene, test::substep_count);
}

TEST(TwinTileTest, ManyStepsOfACloth) { compare_tiles(tiled({16, 11}, 70), {1, 64, 4, 1}); }

TEST(TwinTileTest, HolesWithoutShearSoftInCompression) {
    SceneDescription scene = tiled({41, 37}, 7);
    scene.cloths[0].holes = {{{20, 18}, {40, 36}}, {{1, 0}, {2, 1}}};
    scene.cloths[0].stiffness = {false, 800, 0, 0, 0.1};
    compare_tiles(scene, {1, 2, 2, 1, 1});
}

TEST(TwinTileTest, APinThatLetsGoAndASecondCloth) {
    SceneDescription scene = tiled({16, 11}, 5);
    Pin released = test::pin_box(0, 1, 0, 1);
    released.release = 0.11;
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    scene.cloths[1].placement.origin[0] += 2;
    scene.cloths[0].pins.push_back(released);
    compare_tiles(scene, {1, 1, 1, 3, 1, 1, 1, 1});
}

TEST(TwinTileTest, WindLetsNoStepsGoTogether) {
    SceneDescription scene = tiled({20, 11}, 3);
    scene.wind.velocity = {2, 0.5, -1};
    compare_tiles(scene, {1, 1, 1});
}

TEST(CanaryTest, AMissingBarrierBetweenTilesIsReported) {
    const SimulationModel model(tiled({40, 20}, 12));
    test::ExpectValidationMessages expected;
    test::DeviceRun run(
        test::gpu().device, model,
        [](const graph::PlannedPass&, const graph::Barrier& barrier) {
            return barrier.reason.find("explicit steps") == std::string::npos;
        },
        tile_kernels);
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
