// Relaxation whose springs are swept, an iteration at once, and cells whose twist is, against the twin, which takes the
// passes one by one.
#include "cloth/kernel_steps.h"
#include "twin_comparison.h"

namespace drape {
namespace {

/// Columns, rows.
using Grid2 = std::pair<std::uint32_t, std::uint32_t>;

std::string name_of(const testing::TestParamInfo<Grid2>& grid) {
    return std::to_string(grid.param.first) + "x" + std::to_string(grid.param.second);
}

SceneDescription swept(Grid2 grid) { return test::thrown_sheet(grid, 5); }

/// `sweeps`: how many of them a frame must have, so that the comparison means something. With the tensions that the
/// stretch error asks for, where stretch springs give.
void compare(const SceneDescription& scene, std::ptrdiff_t sweeps) {
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), stream_kernels);
    EXPECT_EQ(std::ranges::count(steps, StepKind::all_springs, &Step::kind), sweeps);
    const Stiffness& stiffness = scene.cloths[0].stiffness;
    const bool tense = !stiffness.rigid && stiffness.stretch.least() > 0;
    test::compare(scene, {}, test::gpu().device, {.drawing = true, .statistics = tense});
}

class TwinSweepTest : public testing::TestWithParam<Grid2> {};

TEST_P(TwinSweepTest, Plain) { compare(swept(GetParam()), 5); }

TEST_P(TwinSweepTest, RigidInTwoIterations) {
    SceneDescription scene = swept(GetParam());
    scene.cloths[0].stiffness.rigid = true;
    scene.solver.iterations = 2;
    compare(scene, 10);
}

TEST_P(TwinSweepTest, TensionCarriedOverTwoIterations) {
    SceneDescription scene = swept(GetParam());
    scene.solver.iterations = 2;
    compare(scene, 10);
}

/// After an odd number tension comes home from the other images.
TEST_P(TwinSweepTest, TensionCarriedOverThreeWithHolesAndSoftInCompression) {
    SceneDescription scene = swept(GetParam());
    const auto [columns, rows] = GetParam();
    if (columns < 4) GTEST_SKIP() << "no room for a hole";
    scene.cloths[0].holes = {{{columns / 2, rows / 2}, {columns - 1, rows - 1}}, {{1, 0}, {2, 1}}};
    scene.cloths[0].stiffness.compression = 0.1;
    scene.solver.iterations = 3;
    compare(scene, 15);
}

TEST_P(TwinSweepTest, WithoutShear) {
    SceneDescription scene = swept(GetParam());
    scene.cloths[0].stiffness = {false, 800, 0, 0};
    compare(scene, 5);
}

TEST_P(TwinSweepTest, ShearAlone) {
    SceneDescription scene = swept(GetParam());
    scene.cloths[0].stiffness = {false, 0, 60, 0};
    compare(scene, 5);
}

TEST_P(TwinSweepTest, WithHolesAndSoftInCompression) {
    SceneDescription scene = swept(GetParam());
    const auto [columns, rows] = GetParam();
    if (columns < 4) GTEST_SKIP() << "no room for a hole";
    scene.cloths[0].holes = {{{columns / 2, rows / 2}, {columns - 1, rows - 1}}, {{1, 0}, {2, 1}}};
    scene.cloths[0].stiffness.compression = 0.1;
    compare(scene, 5);
}

// One strip, one that just fits, one column more, the two columns after which a strip's halo begins, several strips;
// two bands of rows, and three.
INSTANTIATE_TEST_SUITE_P(Grids, TwinSweepTest,
                         testing::Values(Grid2{2, 2}, Grid2{3, 3}, Grid2{7, 2}, Grid2{47, 5}, Grid2{48, 8},
                                         Grid2{49, 7}, Grid2{84, 9}, Grid2{85, 12}, Grid2{129, 40}, Grid2{5, 257},
                                         Grid2{52, 391}),
                         name_of);

TEST(TwinSweepTest, AmongWindBendingPinsThatMoveAndLetGoAndColliders) {
    SceneDescription scene = test::everything();  // letting go asks for tension
    scene.cloths[0].stiffness.bend = 1e-3;
    compare(scene, test::substep_count);
    scene.solver.iterations = 2;
    compare(scene, 2 * test::substep_count);
    std::erase_if(scene.cloths[0].pins, [](const Pin& pin) { return pin.release.has_value(); });
    scene.solver.iterations = 1;
    compare(scene, test::substep_count);
}

TEST(TwinSweepTest, TensionOfSomeDirectionsAloneIsNotSwept) {
    SceneDescription scene = swept({20, 9});
    scene.solver.iterations = 2;
    scene.cloths[0].stiffness = {false, 800, 0, 0};
    compare(scene, 0);
    scene.cloths[0].stiffness = {false, 0, 60, 0};
    compare(scene, 0);
}

TEST(TwinSweepTest, OfClothsTogetherAndOneThatLetsGo) {
    SceneDescription scene = swept({20, 9});
    for (const char* name : {"second", "third"}) {
        Cloth& cloth = scene.cloths.emplace_back(scene.cloths[0]);
        cloth.name = name;
        cloth.placement.origin[0] += 2 * static_cast<double>(scene.cloths.size());
    }
    scene.cloths[1].pins[1].release = 0.05;
    compare(scene, 3 * 5);
    scene.solver.iterations = 2;
    compare(scene, 3 * 2 * 5);
}

TEST(TwinSweepTest, IterationsThatTheDeviceMayLeaveOutAreNotSwept) {
    SceneDescription scene = swept({20, 9});
    scene.cloths[0].stiffness.rigid = true;
    scene.solver.iterations = 3;
    scene.solver.tolerance = 0.05;
    compare(scene, 5);
    scene.cloths[0].stiffness.rigid = false;  // what follows finds the first iteration's tension
    compare(scene, 5);
}

/// With cells that twist.
void compare_twist(SceneDescription scene) {
    scene.cloths[0].stiffness.bend = 1e-3;
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), stream_kernels);
    EXPECT_EQ(std::ranges::count(steps, StepKind::all_twist, &Step::kind), scene.solver.substeps);
    EXPECT_EQ(std::ranges::count(steps, StepKind::twist, &Step::kind), 0);
    test::compare(scene, {}, test::gpu().device, {.drawing = true});
}

class TwinTwistSweepTest : public testing::TestWithParam<Grid2> {};

/// First orders and second ones, as nothing is touched.
TEST_P(TwinTwistSweepTest, OfLines) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 6);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].pins.pop_back();
    compare_twist(scene);
}

TEST_P(TwinTwistSweepTest, OfLinesWithHolesInWind) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 3);
    const auto [columns, rows] = GetParam();
    if (columns < 4) GTEST_SKIP() << "no room for a hole";
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].holes = {{{columns / 2, rows / 2}, {columns - 1, rows - 1}}, {{1, 0}, {2, 1}}};
    scene.wind.velocity = {2, 0.5, -1};
    compare_twist(scene);
}

TEST_P(TwinTwistSweepTest, OfRelaxation) { compare_twist(swept(GetParam())); }

// As above; strips of other halos.
INSTANTIATE_TEST_SUITE_P(Grids, TwinTwistSweepTest,
                         testing::Values(Grid2{2, 2}, Grid2{3, 3}, Grid2{7, 2}, Grid2{47, 5}, Grid2{48, 8},
                                         Grid2{49, 7}, Grid2{88, 9}, Grid2{89, 12}, Grid2{129, 40}, Grid2{5, 257},
                                         Grid2{52, 391}),
                         name_of);

TEST(TwinTwistSweepTest, OfLinesAmongPinsThatMoveAndLetGoAndColliders) {
    SceneDescription scene = test::everything();
    scene.solver.method = SolverMethod::line;
    compare_twist(scene);
}

TEST(CanaryTest, AMissingBarrierBeforeASweepIsReported) {
    if (!test::layer_sees_shared_memory()) GTEST_SKIP() << "the layer sees no hazards of what sweeps store";
    const SimulationModel model(swept({20, 9}));
    test::ExpectValidationMessages expected;
    DeviceRun run(
        test::gpu().device, model,
        [](const graph::PlannedPass&, const graph::Barrier& barrier) {
            return barrier.reason.find("force") == std::string::npos;
        },
        stream_kernels);
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
