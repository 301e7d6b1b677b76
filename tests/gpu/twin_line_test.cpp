// The line solver on the device equals its C++ twin bit for bit (lavapipe), over more than 200 substeps, in both
// orders.
#include "twin_comparison.h"

namespace drape {
namespace {

using test::add_second_cloth;
using test::compare;
using test::DeviceRun;
using test::everything;
using test::everything_in_lines;
using test::frame_count;
using test::free_lines;
using test::lone_pins;

TEST(TwinLineTest, EverythingAtOnce) { compare(everything_in_lines()); }

TEST(TwinLineTest, SecondOrder) {
    const SimulationModel model(free_lines());
    ASSERT_TRUE(model.cloths[0].scheme.second_order);
    compare(free_lines());
}

TEST(TwinLineTest, BothOrdersTakeTurnsWhereAnEdgeJerksTheCloth) {
    SceneDescription scene = free_lines();
    Pin jerked = test::pin_top(scene.cloths[0]);
    jerked.path.keys = {{0.05, {0, 0, 0}, {}}, {0.1, {3, 1.5, 0}, {}}};
    scene.cloths[0].pins = {jerked};
    const SimulationModel model(scene);
    Twin twin(model);
    std::array<bool, 3> seen{};
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        twin.run_frame(frame);
        seen[twin.cloth(0).integers(Field::line_control)[glsl::control_order]] = true;
    }
    EXPECT_TRUE(seen[1] && seen[2]) << "the control must have switched";
    compare(scene);
}

TEST(TwinLineTest, StrainedSpringsAtLonePinsLeaveTheSecondOrderAlone) {
    SceneDescription scene = test::sheet(129, 129, 1, 1, 4);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].placement.v = {0, 0, 1};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(128, 0, 128, 0)};
    const SimulationModel model(scene);
    Twin twin(model);
    std::uint32_t most_wrong = 0;
    for (std::uint32_t frame = 1; frame <= 15; ++frame) {
        twin.run_frame(frame);
        const auto& control = twin.cloth(0).integers(Field::line_control);
        EXPECT_EQ(control[glsl::control_order], 2u) << "frame " << frame;
        most_wrong = std::max(most_wrong, control[glsl::control_wrong_lines]);
    }
    EXPECT_GT(most_wrong, 0u);
}

TEST(TwinLineTest, ThreeIterationsWithTensionHolesAndTwoCloths) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 3;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 20}, {36, 29}}};
    add_second_cloth(scene);
    compare(scene);
}

TEST(TwinLineTest, ThreeIterationsWithColliders) {
    SceneDescription scene = everything_in_lines();
    scene.solver.iterations = 3;
    scene.solver.collide = CollideWhen::substep;
    compare(scene);
}

TEST(TwinLineTest, HolesWithColliders) {
    SceneDescription scene = everything_in_lines();
    scene.wind = {};
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}};
    compare(scene);
}

TEST(TwinLineTest, HolesInThreeIterationsWithColliders) {
    SceneDescription scene = everything_in_lines();
    scene.solver.iterations = 3;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}};
    compare(scene);
}

TEST(TwinLineTest, BendingHolesAndNoWind) {
    SceneDescription scene = free_lines();
    scene.wind = {};
    scene.cloths[0].stiffness.bend = 1e-4;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}, {{25, 15}, {26, 16}}};
    compare(scene);
}

TEST(TwinLineTest, StiffBendingInTwoIterations) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 2;
    scene.cloths[0].stiffness.bend = 1e-2;
    compare(scene);
}

TEST(TwinLineTest, BendingWithColliders) {
    SceneDescription scene = everything_in_lines();
    scene.cloths[0].stiffness.bend = 1e-3;
    compare(scene);
}

TEST(TwinLineTest, BendingAlone) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness = {false, 0, 0, 1e-4};
    compare(scene);
}

TEST(TwinLineTest, RigidSpringsAndPinsAtBothEnds) {
    SceneDescription scene = free_lines();
    scene.cloths[0].stiffness.rigid = true;
    scene.cloths[0].pins.push_back(test::pin_box(0, 29, 36, 29));
    compare(scene);
}

TEST(TwinLineTest, RigidSpringsInTwoIterations) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 2;
    scene.cloths[0].stiffness.rigid = true;
    compare(scene);
}

TEST(TwinLineTest, SoftInCompressionWithHolesAndBendingInTwoIterations) {
    SceneDescription scene = everything_in_lines();
    scene.cloths[0].stiffness = {false, 800, 60, 1e-5, 0.05};
    compare(scene);
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}};
    scene.solver.iterations = 2;
    compare(scene);
}

TEST(TwinLineTest, StretchAloneInThreeIterations) {
    SceneDescription scene = free_lines();
    scene.solver.iterations = 3;
    scene.cloths[0].stiffness = {false, 1e5, 0, 0};
    compare(scene);
}

class TwinLineGrid : public testing::TestWithParam<std::array<std::uint32_t, 2>> {};

TEST_P(TwinLineGrid, EveryShapeOfGrid) {
    SceneDescription scene = test::sheet(GetParam()[0], GetParam()[1], 1.0, 0.7, test::substep_count);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].velocity = {0.5, 0, 1};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0)};
    compare(scene);
    scene.cloths[0].stiffness.bend = 1e-3;
    compare(scene);
}

INSTANTIATE_TEST_SUITE_P(Sizes, TwinLineGrid,
                         testing::Values(std::array<std::uint32_t, 2>{2, 2}, std::array<std::uint32_t, 2>{2, 33},
                                         std::array<std::uint32_t, 2>{41, 2}, std::array<std::uint32_t, 2>{9, 8},
                                         // Rows of buffer views without padding: of floats, of vectors.
                                         std::array<std::uint32_t, 2>{32, 17}, std::array<std::uint32_t, 2>{20, 11},
                                         std::array<std::uint32_t, 2>{65, 33}));

TEST(TwinLineTest, NestedBoxesAroundLonePins) {
    const SimulationModel model(lone_pins());
    ASSERT_EQ(model.cloths[0].scheme.iterated.size(), 4u + 3u) << "lines, and rounds of pins";
    compare(lone_pins());
}

TEST(TwinLineTest, NestedBoxesOfSpringsSoftInCompression) {
    SceneDescription scene = lone_pins();
    scene.cloths[0].stiffness.compression = 0.03;
    compare(scene);
}

TEST(TwinLineTest, NestedBoxesAndAContact) {
    SceneDescription scene = lone_pins();
    scene.colliders.push_back({Sphere{{0.3, -0.5, 0.2}, 0.25}});
    scene.cloths[0].holes = {{{3, 4}, {9, 10}}};
    compare(scene);
}

TEST(TwinLineTest, NestedBoxesWithHolesAndNoShear) {
    SceneDescription scene = lone_pins();
    scene.cloths[0].stiffness.shear = 0;
    scene.cloths[0].holes = {{{3, 4}, {9, 10}}, {{52, 25}, {60, 33}}};
    scene.solver.iterations = 2;
    compare(scene);
}

/// A flag that its pole lets go, in wind, and free sheets with damping, which are summed in two workgroups, one alone
/// and two together.
TEST(TwinLineTest, ClothThatKeepsItsAngularMomentum) {
    SceneDescription flag = free_lines();
    Pin pole = test::pin_box(0, 0, 0, flag.cloths[0].grid[1] - 1);
    pole.release = 0.15;
    flag.cloths[0].placement = {{0, 1, 0}, {1, 0, 0}, {0, -1, 0}};
    flag.cloths[0].pins = {pole};
    flag.wind.velocity = {3, 0.5, 1};
    SceneDescription free = test::thrown_sheet({47, 31}, 12);
    free.solver.method = SolverMethod::line;
    free.cloths[0].pins.clear();
    free.cloths[0].damping = 0.5;
    SceneDescription together = free;
    add_second_cloth(together);
    together.cloths[1].grid = together.cloths[0].grid;
    together.cloths[1].pins.clear();
    for (const SceneDescription& scene : {flag, free, together}) {
        const SimulationModel model(scene);
        for (const ClothModel& cloth : model.cloths) ASSERT_FALSE(cloth.scheme.ended.empty());
        compare(scene);
    }
}

TEST(TwinLineTest, TethersInSecondOrder) {
    SceneDescription scene = free_lines();
    scene.solver.tethers = true;
    compare(scene);
}

TEST(TwinTetherTest, EveryMethodWithHolesAndColliders) {
    SceneDescription scene = everything();
    scene.solver.tethers = true;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 20}, {36, 29}}};
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        scene.solver.method = method;
        compare(scene);
    }
}

TEST(TwinLineTest, ExactSkipsChangeNoBit) {
    const SceneDescription scene = free_lines();
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

TEST(CanaryTest, AMissingBarrierBetweenLinePassesIsReported) {
    const SimulationModel model(free_lines());
    test::ExpectValidationMessages expected;
    DeviceRun run(
        test::gpu().device, model,
        [](const graph::PlannedPass&, const graph::Barrier& barrier) {
            return barrier.reason.find("line row") == std::string::npos;
        },
        test::layer_sees_shared_memory() ? Kernels::automatic() : Kernels{Kernel::plain});
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
