// The forces that a scene asks for, against statics, Coulomb's law, drag and the momenta of impacts, for every method.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "simulated.h"
#include "support/force_scenes.h"

namespace drape {
namespace {

using test::all_methods;
using test::by_method;
using test::expect_near;
using test::level_sheet;
using test::Simulated;

class ForcesTest : public testing::TestWithParam<SolverMethod> {};

TEST_P(ForcesTest, PinsBearTheWeightOfClothThatHangs) {
    SceneDescription scene = level_sheet(0, 12);
    scene.cloths[0].placement.v = {0, -1, 0};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    Simulated run(by_method(scene, GetParam(), 12));
    run.frames(240);
    expect_near(run.force("pins_0"), {0, run.weight(), 0}, 1e-4, "a hanging sheet's pins");
    expect_near(run.force("gravity"), {0, -run.weight(), 0}, 1e-6, "its weight");
}

TEST_P(ForcesTest, EachEndOfACatenaryBearsItsTension) {
    // Relaxation stretches cloth as (N/passes)^2.
    Simulated run(by_method(test::catenary(), GetParam(), GetParam() == SolverMethod::relax ? 400 : 24));
    run.frames(360);
    const Vec3 left = test::catenary_pull(run.weight());
    expect_near(run.force("pins_0"), left, 1e-4, "the left end");
    expect_near(run.force("pins_1"), {-left[0], left[1], 0}, 1e-4, "the right end");
    EXPECT_NEAR(length(test::catenary_pull(run.weight(), 1e9)) / run.weight(), 0.6036, 0.001)
        << "docs/physics.md, section 7";
}

TEST_P(ForcesTest, ABoxBearsASheetAndItsMoment) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.cloths[0].placement.origin[0] += 0.05;
    scene.colliders = {{Plane{{0, 1, 0}, -1}, 0.5}, {Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(150);
    const double weight = run.weight();
    expect_near(run.force("collider_1_box"), {0, weight, 0}, 1e-4, "the box under a sheet");
    expect_near(run.moment("collider_1_box"), {0, 0, 0.05 * weight}, 1e-4, "its moment");
    EXPECT_EQ(length(run.force("collider_0_plane")), 0);
}

TEST_P(ForcesTest, FrictionOfASheetThatSlidesIsCoulombs) {
    SceneDescription scene = level_sheet(0.004, 0);
    scene.cloths[0].velocity = {2, 0, 0};
    scene.colliders = {{Plane{}, 0.3}};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(20);
    expect_near(run.force("collider_0_plane"), {-0.3 * run.weight(), run.weight(), 0}, 1e-4, "a plane under a slide");
}

TEST_P(ForcesTest, DragIsTheWeightAtTheTerminalVelocity) {
    SceneDescription scene = level_sheet(0, 0);
    scene.wind.velocity = {0, 2, 0};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(120);
    expect_near(run.force("air"), {0, run.weight(), 0}, 1e-4, "the drag");
}

TEST_P(ForcesTest, AnImpactGivesTheMomentumThatItTakes) {
    SceneDescription scene = level_sheet(0.1, 0);
    scene.cloths[0].velocity = {0, -3, 0};
    scene.colliders = {{Plane{}, 0.3}};
    Simulated run(by_method(scene, GetParam(), 8));
    double given = 0;
    constexpr std::uint32_t frames = 12;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        run.frames(1);
        given += run.force("collider_0_plane")[1] * run.frame_time();
    }
    const double mass = run.statistics().mass;
    expect_near({0, given, 0}, {0, mass * (3 + 9.81 * frames * run.frame_time()), 0}, 1e-4, "an impact");
}

/// The last substep of a frame has the most of a pull that grows, and what rests bears the same in every substep.
TEST_P(ForcesTest, TheWorstSubstepIsTold) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.worst_forces = true;
    scene.colliders = {{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    scene.cloths[0].loads = {test::pull({{0, 0}, {8, 8}}, std::vector<VectorKey>{{0, {}}, {10, {0, -2, 0}}})};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(150);
    const double substep = run.frame_time() / run.model().scene.solver.substeps, now = 150 * run.frame_time();
    const Vec3 pull{0, -0.2 * (now - 0.5 * substep), 0};
    expect_near(run.worst("loads"), pull, 1e-5, "the last substep's load");
    expect_near(run.worst("collider_0_box"), {0, run.weight() - pull[1], 0}, 1e-4, "the box, in the worst substep");
    EXPECT_LT(length(run.force("loads")), length(run.worst("loads")));
}

/// A floor stops level cloth within few substeps, so the peak is far above the mean, and no substep gives more than all
/// of the frame.
TEST_P(ForcesTest, ABlowHasAPeak) {
    SceneDescription scene = level_sheet(0.02, 0);
    scene.worst_forces = true;
    scene.cloths[0].velocity = {0, -3, 0};
    scene.colliders = {{Plane{}, 0.3}};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(1);
    const double substeps = run.model().scene.solver.substeps, mean = run.force("collider_0_plane")[1];
    const double peak = run.worst("collider_0_plane")[1];
    EXPECT_GE(peak, 2 * mean);
    EXPECT_LE(peak, substeps * mean * (1 + 1e-6));
}

INSTANTIATE_TEST_SUITE_P(Methods, ForcesTest, testing::ValuesIn(all_methods),
                         [](const auto& each) { return std::string(named(each.param).name); });

TEST(ForcesSumTest, ForcesAddUpToTheChangeOfMomentumInEveryFrame) {
    constexpr std::uint32_t seed = 20261129;
    std::mt19937 random(seed);
    double worst = 0;
    for (int scene = 0; scene < 40; ++scene) {
        Simulated run(test::drawn_with_forces(random));
        const std::size_t cloths = run.model().cloths.size();
        std::vector<Vec3> before;
        for (std::size_t cloth = 0; cloth < cloths; ++cloth) before.push_back(run.statistics(cloth).momentum);
        for (int frame = 0; frame < 25; ++frame) {
            run.frames(1);
            for (std::size_t cloth = 0; cloth < cloths; ++cloth) {
                const ClothStatistics now = run.statistics(cloth);
                worst = std::max(worst, test::missing_force(now, before[cloth], run.frame_time()));
                before[cloth] = now.momentum;
            }
        }
    }
    std::printf("[ measured ] seed %u: the sums are off by %.1e of the largest force at most\n", seed, worst);
    EXPECT_LT(worst, 1e-4);
}

TEST(ForcesSumTest, AskingChangesNoBitOfTheMotion) {
    std::mt19937 random(7);
    for (int k = 0; k < 9; ++k) {
        const SceneDescription scene = test::drawn_with_forces(random);
        Simulated asked(scene);
        const SimulationModel model(scene);
        Twin plain(model);
        asked.frames(12);
        for (std::uint32_t frame = 1; frame <= 12; ++frame) plain.run_frame(frame);
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            for (const Field field : {Field::position, Field::displacement})
                EXPECT_TRUE(
                    std::ranges::equal(asked.twin().cloth(cloth).bytes(field), plain.cloth(cloth).bytes(field)));
    }
}

}  // namespace
}  // namespace drape
