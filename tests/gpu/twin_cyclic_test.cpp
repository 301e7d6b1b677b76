// Lines solved by cyclic reduction on the device equal the twin's that do the same, bit for bit (lavapipe).
#include "cloth/kernel_steps.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::everything_in_lines;
using test::free_lines;

/// `reduced`: how many passes along lines a frame must have that are, `others`: that are not.
void compare_reduced(const SceneDescription& scene, std::ptrdiff_t reduced, std::ptrdiff_t others = 0,
                     const Kernels& kernels = cyclic_kernels) {
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), kernels);
    const auto count = [&](bool is_reduced) {
        return std::ranges::count_if(steps, [&](const Step& step) {
            return step.kind == StepKind::line && (step.kernel == Kernel::line_cyclic) == is_reduced;
        });
    };
    EXPECT_EQ(count(true), reduced);
    EXPECT_EQ(count(false), others);
    test::compare(scene, {}, test::gpu().device, {.drawing = true}, kernels);
}

constexpr std::ptrdiff_t passes = 4 * test::substep_count;

TEST(TwinCyclicTest, EverythingAtOnce) { compare_reduced(everything_in_lines(), passes); }

TEST(TwinCyclicTest, SecondOrder) { compare_reduced(free_lines(), passes); }

TEST(TwinCyclicTest, ThreeIterationsWithTensionHolesAndTwoCloths) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 3;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 20}, {36, 29}}};
    test::add_second_cloth(scene);
    compare_reduced(scene, 2 * 3 * passes);
}

TEST(TwinCyclicTest, IterationsThatTheDeviceMayLeaveOut) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 3;
    scene.solver.tolerance = 0.01;
    compare_reduced(scene, 3 * passes);
}

TEST(TwinCyclicTest, BendingWithEverythingAtOnce) {
    SceneDescription scene = everything_in_lines();
    scene.cloths[0].stiffness.bend = 1e-3;
    compare_reduced(scene, passes);
}

TEST(TwinCyclicTest, BendingInTwoIterationsWithHolesAndTwoCloths) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 2;
    scene.cloths[0].stiffness.bend = 1e-2;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}, {{25, 15}, {26, 16}}};
    test::add_second_cloth(scene);
    compare_reduced(scene, 2 * 2 * passes);
}

TEST(TwinCyclicTest, BendingAlone) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness = {false, 0, 0, 1e-4};
    compare_reduced(scene, passes / 2);
}

TEST(TwinCyclicTest, BendingRigidSpringsAndPinsAtBothEnds) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness.rigid = true;
    scene.cloths[0].stiffness.bend = 1;
    scene.cloths[0].pins.push_back(test::pin_box(0, 29, 36, 29));
    compare_reduced(scene, passes);
}

TEST(TwinCyclicTest, LinesThatBendTooStifflyAreWalked) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness.bend = 20;
    compare_reduced(scene, passes / 2, passes / 2);
}

TEST(TwinCyclicTest, SoftInCompressionWithoutShear) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness = {false, 800, 0, 0, 0.05};
    compare_reduced(scene, passes / 2);
}

TEST(TwinCyclicTest, BothOrdersTakeTurnsWhereAnEdgeJerksTheCloth) {
    SceneDescription scene = free_lines();
    Pin jerked = test::pin_top(scene.cloths[0]);
    jerked.path.keys = {{0.05, {0, 0, 0}, {}}, {0.1, {3, 1.5, 0}, {}}};
    scene.cloths[0].pins = {jerked};
    compare_reduced(scene, passes);
}

TEST(TwinCyclicTest, LinesThatAreTooLongAreWalked) {
    SceneDescription scene = test::thrown_sheet({1026, 3}, 1);
    scene.solver.method = SolverMethod::line;
    compare_reduced(scene, 3, 1);
}

TEST(TwinCyclicTest, BendingLinesAsLongAsAWorkgroupHoldsAndLonger) {
    const auto line = [](std::uint32_t particles) {
        SceneDescription scene = test::thrown_sheet({particles, 3}, 1);
        scene.solver.method = SolverMethod::line;
        scene.cloths[0].stiffness.bend = 1e-8;
        return scene;
    };
    Kernels small = cyclic_kernels;
    small.group.shared_bytes = 16384;
    compare_reduced(line(896), 4);
    compare_reduced(line(897), 3, 1);
    compare_reduced(line(448), 4, 0, small);
    compare_reduced(line(449), 3, 1, small);
}

class TwinCyclicGridTest : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};

TEST_P(TwinCyclicGridTest, RigidLines) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].stiffness.rigid = true;
    compare_reduced(scene, 4 * 5);
}

TEST_P(TwinCyclicGridTest, BendingLines) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].stiffness.bend = 5e-3;
    compare_reduced(scene, 4 * 5);
    const auto [columns, rows] = GetParam();
    if (columns < 3 || rows < 5) return;
    scene.cloths[0].holes = {{{0, 1}, {columns / 3, 3}}};
    compare_reduced(scene, 4 * 5);
}

// One spring; lines that fill a subgroup, one particle more, whole powers of two; a workgroup's last line alone.
INSTANTIATE_TEST_SUITE_P(Grids, TwinCyclicGridTest,
                         testing::Values(std::pair{2u, 2u}, std::pair{3u, 7u}, std::pair{32u, 5u}, std::pair{33u, 65u},
                                         std::pair{64u, 20u}, std::pair{130u, 5u}),
                         [](const auto& grid) {
                             return std::to_string(grid.param.first) + "x" + std::to_string(grid.param.second);
                         });

TEST(CanaryTest, AMissingBarrierBetweenReducedLinesIsReported) {
    const SimulationModel model(free_lines());
    test::ExpectValidationMessages expected;
    test::DeviceRun run(
        test::gpu().device, model,
        [](const graph::PlannedPass&, const graph::Barrier& barrier) {
            return barrier.reason.find("line row") == std::string::npos;
        },
        cyclic_kernels);
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
