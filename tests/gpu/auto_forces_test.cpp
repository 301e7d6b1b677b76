// Forces by method auto, which judges frames and does some again: against statics, drag, the momentum of an impact, and
// their sum against the change of momentum in every frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "library_device.h"
#include "support/force_scenes.h"
#include "support/sewn_scenes.h"

namespace drape {
namespace {

using test::expect_near;
using test::level_sheet;
using AutoForcesTest = test::LibraryTest;

/// A run by auto, whose statistics are kept.
class AutoRun {
  public:
    AutoRun(SceneDescription scene, std::uint32_t last) : fps_(scene.time.fps) {
        scene.solver = {};  // auto
        scene.forces = true;
        scene.time.frame_count = last + 1;
        Simulation simulation(scene, {}, test::library_device());
        while (simulation.step()) {
            frames_.push_back(simulation.frame().statistics);
            substeps_.push_back(simulation.frame().effort.substeps);
        }
    }

    const std::vector<ClothStatistics>& at(std::size_t frame) const { return frames_.at(frame); }
    std::uint32_t substeps(std::size_t frame) const { return substeps_.at(frame); }
    std::size_t last() const { return frames_.size() - 1; }
    double frame_time() const { return 1 / fps_; }
    double weight() const { return 9.81 * at(0)[0].mass; }
    ForceOnCloth told(const std::string& by, std::size_t frame) const {
        for (const ForceOnCloth& each : at(frame)[0].forces)
            if (each.by == by) return each;
        ADD_FAILURE() << "no force by " << by;
        return {};
    }
    Vec3 force(const std::string& by, std::size_t frame) const { return told(by, frame).force; }
    Vec3 force(const std::string& by) const { return force(by, last()); }
    Vec3 worst(const std::string& by) const { return told(by, last()).worst.value_or(Vec3{}); }

  private:
    double fps_;
    std::vector<std::vector<ClothStatistics>> frames_;
    std::vector<std::uint32_t> substeps_;
};

SceneDescription hanging() {
    SceneDescription scene = level_sheet(0, 12);
    scene.cloths[0].placement.v = {0, -1, 0};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    return scene;
}

TEST_F(AutoForcesTest, PinsBearTheWeight) {
    const AutoRun run(hanging(), 150);
    expect_near(run.force("pins_0"), {0, run.weight(), 0}, 1e-4, "a hanging sheet's pins");
}

TEST_F(AutoForcesTest, PinsBearAWeightOnACorner) {
    SceneDescription scene = hanging();
    scene.cloths[0].loads = {test::pull({{8, 8}, {8, 8}}, Vec3{0, -1, 0})};
    const AutoRun run(scene, 200);
    expect_near(run.force("pins_0"), {0, run.weight() + 1, 0}, 1e-4, "the pins under a weight");
}

TEST_F(AutoForcesTest, AClampBearsThePullOfTheOther) {
    SceneDescription scene = level_sheet(0, 12);
    scene.gravity = {};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 8)};
    scene.cloths[0].loads = {test::pull({{8, 0}, {8, 8}}, Vec3{20, 0, 0})};
    const AutoRun run(scene, 150);
    expect_near(run.force("pins_0"), {-20, 0, 0}, 1e-4, "a clamp, pulled by 20 N");
}

TEST_F(AutoForcesTest, EachEndOfACatenaryBearsItsTension) {
    const AutoRun run(test::catenary(), 240);
    const Vec3 left = test::catenary_pull(run.weight());
    expect_near(run.force("pins_0"), left, 1e-4, "the left end");
    expect_near(run.force("pins_1"), {-left[0], left[1], 0}, 1e-4, "the right end");
}

TEST_F(AutoForcesTest, ABoxBearsASheet) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.colliders = {{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    const AutoRun run(scene, 150);
    expect_near(run.force("collider_0_box"), {0, run.weight(), 0}, 1e-4, "the box under a sheet");
}

TEST_F(AutoForcesTest, DragIsTheWeightAtTheTerminalVelocity) {
    SceneDescription scene = level_sheet(0, 0);
    scene.wind.velocity = {0, 2, 0};
    const AutoRun run(scene, 120);
    expect_near(run.force("air"), {0, run.weight(), 0}, 1e-4, "the drag");
}

TEST_F(AutoForcesTest, AnImpactGivesTheMomentumThatItTakes) {
    SceneDescription scene = level_sheet(0.1, 0);
    scene.cloths[0].velocity = {0, -3, 0};
    scene.colliders = {{Plane{}, 0.3}};
    const AutoRun run(scene, 12);
    double given = 0;
    for (std::size_t frame = 1; frame <= run.last(); ++frame)
        given += run.force("collider_0_plane", frame)[1] * run.frame_time();
    const double time = static_cast<double>(run.last()) * run.frame_time();
    expect_near({0, given, 0}, {0, run.at(0)[0].mass * (3 + 9.81 * time), 0}, 1e-4, "an impact");
}

/// The last substep of a frame has the most of a pull that grows, and what rests bears the same in every substep.
TEST_F(AutoForcesTest, TheWorstSubstepIsTold) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.worst_forces = true;
    scene.colliders = {{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    scene.cloths[0].loads = {test::pull({{0, 0}, {8, 8}}, std::vector<VectorKey>{{0, {}}, {10, {0, -2, 0}}})};
    const AutoRun run(scene, 120);
    const double now = 0.2 * 120 * run.frame_time(), mean = now - 0.1 * run.frame_time();
    expect_near(run.force("loads"), {0, -mean, 0}, 1e-5, "the load's mean");
    EXPECT_GT(run.worst("loads")[1], -now);
    EXPECT_LT(run.worst("loads")[1], -(mean + 0.5 * (now - mean)));
    expect_near(run.worst("collider_0_box"), {0, run.weight() - run.worst("loads")[1], 0}, 1e-4,
                "the box, in the worst substep");
}

TEST_F(AutoForcesTest, ForcesAddUpToTheChangeOfMomentum) {
    constexpr std::uint32_t drawn_by = 20261130;
    std::mt19937 random(drawn_by);
    double worst = 0;
    for (int scene = 0; scene < 4; ++scene) {
        const AutoRun run(test::drawn_with_forces(random), 8);
        for (std::size_t frame = 1; frame <= run.last(); ++frame)
            for (std::size_t cloth = 0; cloth < run.at(frame).size(); ++cloth)
                worst = std::max(worst, test::missing_force(run.at(frame)[cloth], run.at(frame - 1)[cloth].momentum,
                                                            run.frame_time()));
    }
    std::printf("[ measured ] seed %u: the sums are off by %.1e of the largest force at most\n", drawn_by, worst);
    EXPECT_LT(worst, 1e-4);
}

TEST_F(AutoForcesTest, SeamsBearWhatHangsFromThem) {
    SceneDescription scene = test::two_panels(SolverMethod::automatic);
    scene.wind = {};
    for (Cloth& cloth : scene.cloths) cloth.damping = 8, cloth.velocity = {};
    scene.cloths[0].placement.v = scene.cloths[1].placement.v = {0, -1, 0};
    scene.cloths[1].placement.origin = {-0.4, -0.05, -0.3};
    const AutoRun run(scene, 260);
    const auto seams = [&](std::size_t cloth) {
        const std::vector<ForceOnCloth>& all = run.at(run.last())[cloth].forces;
        const auto found = std::ranges::find(all, "seams", &ForceOnCloth::by);
        return found == all.end() ? Vec3{} : found->force;
    };
    const double lower = 9.81 * run.at(0)[1].mass;
    expect_near(seams(1), {0, lower, 0}, 1e-4, "what bears the lower panel");
    expect_near(seams(0), {0, -lower, 0}, 1e-4, "what the upper one bears of it");
    expect_near(run.force("pins_0"), {0, run.weight() + lower, 0}, 1e-4, "the pins of both");
    double worst = 0;
    for (std::size_t frame = 2; frame <= run.last(); ++frame) {
        // A change of the substeps changes the momentum of any cloth that swings fast, sewn or not.
        if (run.substeps(frame) != run.substeps(frame - 1)) continue;
        for (std::size_t cloth = 0; cloth < 2; ++cloth)
            worst = std::max(
                worst, test::missing_force(run.at(frame)[cloth], run.at(frame - 1)[cloth].momentum, run.frame_time()));
    }
    std::printf("[ measured ] sewn: the sums are off by %.1e of the largest force at most\n", worst);
    EXPECT_LT(worst, 1e-4);
}

}  // namespace
}  // namespace drape
