// Lines solved in parts on the device equal the twin's that do the same, bit for bit (lavapipe, whose subgroups of
// eight hold lines of up to 128 particles).
#include "cloth/kernel_steps.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::everything_in_lines;
using test::free_lines;

/// `in_parts`: how many passes along lines a frame must have that are, `others`: that are not.
void compare_parts(const SceneDescription& scene, std::ptrdiff_t in_parts, std::ptrdiff_t others = 0) {
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), parts_kernels);
    const auto count = [&](Kernel kernel) {
        return std::ranges::count_if(
            steps, [&](const Step& step) { return step.kind == StepKind::line && step.kernel == kernel; });
    };
    EXPECT_EQ(count(Kernel::line_parts), in_parts);
    EXPECT_EQ(count(Kernel::plain), others);
    test::compare(scene, {}, test::gpu().device, {.drawing = true}, parts_kernels);
}

constexpr std::ptrdiff_t passes = 4 * test::substep_count;

TEST(TwinPartsTest, EverythingAtOnce) { compare_parts(everything_in_lines(), passes); }

TEST(TwinPartsTest, SecondOrder) { compare_parts(free_lines(), passes); }

TEST(TwinPartsTest, ThreeIterationsWithTensionHolesAndTwoCloths) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 3;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 20}, {36, 29}}};
    test::add_second_cloth(scene);
    compare_parts(scene, 2 * 3 * passes);
}

TEST(TwinPartsTest, IterationsThatTheDeviceMayLeaveOut) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 3;
    scene.solver.tolerance = 0.01;
    compare_parts(scene, 3 * passes);
}

TEST(TwinPartsTest, SoftInCompressionWithoutShear) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness = {false, 800, 0, 0, 0.05};
    compare_parts(scene, passes / 2);
}

TEST(TwinPartsTest, BothOrdersTakeTurnsWhereAnEdgeJerksTheCloth) {
    SceneDescription scene = free_lines();
    Pin jerked = test::pin_top(scene.cloths[0]);
    jerked.path.keys = {{0.05, {0, 0, 0}, {}}, {0.1, {3, 1.5, 0}, {}}};
    scene.cloths[0].pins = {jerked};
    compare_parts(scene, passes);
}

TEST(TwinPartsTest, SpringsThatAreAsLongAsAtTheStart) {
    SceneDescription scene = free_lines();
    Cloth& cloth = scene.cloths[0];
    for (std::uint32_t row = 0; row < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cloth.grid[0]; ++column)
            cloth.start.push_back({0.9 * cloth.size[0] * column / (cloth.grid[0] - 1),
                                   0.01 * ((3 * row + 5 * column) % 4),
                                   0.95 * cloth.size[1] * row / (cloth.grid[1] - 1)});
    cloth.placement = {};
    cloth.rest = Rest::start;
    compare_parts(scene, passes);
}

TEST(TwinPartsTest, LinesThatBendAreWalked) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness.bend = 1e-3;
    compare_parts(scene, passes / 2, passes / 2);
}

class TwinPartsGridTest : public testing::TestWithParam<std::pair<std::uint32_t, std::uint32_t>> {};

TEST_P(TwinPartsGridTest, RigidLines) {
    SceneDescription scene = test::thrown_sheet(GetParam(), 5);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].stiffness.rigid = true;
    compare_parts(scene, 4 * 5);
    const auto [columns, rows] = GetParam();
    if (columns < 3 || rows < 5) return;
    scene.cloths[0].holes = {{{0, 1}, {columns / 3, 3}}};
    compare_parts(scene, 4 * 5);
}

// One spring; what an invocation has and one particle more; what a part has, and more; diagonals that go round several
// times; the longest lines.
INSTANTIATE_TEST_SUITE_P(Grids, TwinPartsGridTest,
                         testing::Values(std::pair{2u, 2u}, std::pair{3u, 7u}, std::pair{8u, 9u}, std::pair{32u, 33u},
                                         std::pair{2u, 127u}, std::pair{64u, 65u}, std::pair{97u, 96u},
                                         std::pair{128u, 5u}),
                         [](const auto& grid) {
                             return std::to_string(grid.param.first) + "x" + std::to_string(grid.param.second);
                         });

TEST(TwinPartsTest, LinesThatAreTooLongAreWalked) {
    SceneDescription scene = test::thrown_sheet({129, 3}, 1);
    scene.solver.method = SolverMethod::line;
    compare_parts(scene, 3, 1);
}

}  // namespace
}  // namespace drape
