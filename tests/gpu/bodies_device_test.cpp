// Bodies that cloth moves, as the library hands them out: of ensembles as alone, saved and restored, drawn where they
// are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drape/ensemble.h"
#include "drape/simulation.h"
#include "library_device.h"
#include "support/sheets.h"

namespace drape {
namespace {

using test::library_device;
using BodiesDeviceTest = test::LibraryTest;

/// A ball that falls into a sheet held along its edges.
SceneDescription ball_on_a_sheet(double mass, double beside) {
    SceneDescription scene = test::sheet(13, 13, 0.6, 0.6, 32);
    scene.solver.method = SolverMethod::line;
    scene.time.frame_count = 40;
    scene.image.size = {160, 120};
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 500, 50, 0};
    cloth.placement = {{-0.3, 0.5, -0.3}, {1, 0, 0}, {0, 0, 1}};
    cloth.pins = {test::pin_box(0, 0, 12, 0), test::pin_box(0, 12, 12, 12), test::pin_box(0, 0, 0, 12),
                  test::pin_box(12, 0, 12, 12)};
    Collider ball{Sphere{{beside, 0.65, 0}, 0.1}};
    ball.mass = mass;
    ball.color = {1, 0, 0};
    ball.angular_velocity = {0, 3, 1};
    scene.colliders = {Collider{Plane{}}, ball};
    return scene;
}

bool same(const BodyState& one, const BodyState& other) {
    return one.position == other.position && one.turn == other.turn && one.velocity == other.velocity &&
           one.angular_velocity == other.angular_velocity;
}

std::vector<BodyState> alone(const SceneDescription& scene, std::uint32_t frames) {
    Simulation simulation(scene, {}, library_device());
    std::vector<BodyState> all;
    for (std::uint32_t frame = 0; frame < frames && simulation.step(); ++frame)
        all.push_back(simulation.frame().bodies.at(0));
    return all;
}

TEST_F(BodiesDeviceTest, ScenesTogetherKeepTheirOwnBodies) {
    const std::vector<SceneDescription> scenes{ball_on_a_sheet(0.2, 0), ball_on_a_sheet(0.4, 0.1)};
    std::vector<Simulation> together = Simulation::together(scenes, {{}, {}}, library_device());
    std::vector<std::vector<BodyState>> found(2);
    std::vector<FrameRequest> requests(2);
    for (std::size_t k = 0; k < 2; ++k)
        requests[k] = {20, [](std::uint32_t) { return true; },
                       [&found, k](const FinishedFrame& frame) { found[k].push_back(frame.bodies.at(0)); }};
    Simulation::run_together(together, requests);
    for (std::size_t k = 0; k < 2; ++k) {
        const std::vector<BodyState> own = alone(scenes[k], 21);
        ASSERT_EQ(found[k].size(), own.size());
        for (std::size_t frame = 0; frame < own.size(); ++frame)
            EXPECT_TRUE(same(found[k][frame], own[frame])) << "scene " << k << ", frame " << frame;
    }
}

TEST_F(BodiesDeviceTest, WhatIsSavedGoesOnToTheSameBits) {
    const SceneDescription scene = ball_on_a_sheet(0.2, 0.05);
    Simulation first(scene, {}, library_device());
    for (int frame = 0; frame < 20; ++frame) first.step();
    const SimulationState state = first.save();
    Simulation second(scene, {}, library_device());
    second.restore(state);
    for (int frame = 0; frame < 10; ++frame) {
        first.step();
        second.step();
        EXPECT_TRUE(same(first.frame().bodies.at(0), second.frame().bodies.at(0)));
    }
    EXPECT_LT(first.frame().bodies[0].position[1], 0.65);
}

TEST_F(BodiesDeviceTest, AMassIsNoneOfMethodAutoAndOfAPath) {
    SceneDescription scene = ball_on_a_sheet(0.2, 0);
    scene.solver.method = SolverMethod::automatic;
    EXPECT_THROW(Simulation(scene, {}, library_device()), Error);
    scene = ball_on_a_sheet(0.2, 0);
    scene.colliders[1].path.keys = {{}};
    EXPECT_THROW(Simulation(scene, {}, library_device()), Error);
}

/// Returns the mean row of the red pixels; nothing where there are none.
std::optional<double> red_row(std::span<const std::uint8_t> rgba, std::uint32_t width) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; 4 * i < rgba.size(); ++i)
        if (rgba[4 * i] > 100 && rgba[4 * i + 1] < 70 && rgba[4 * i + 2] < 70) {
            sum += static_cast<double>(i / width);
            ++count;
        }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

TEST_F(BodiesDeviceTest, PicturesShowABodyWhereItIs) {
    SceneDescription scene = ball_on_a_sheet(0.2, 0);
    std::get<Sphere>(scene.colliders[1].shape).center[1] = 0.9;
    scene.camera = Camera{{0, 0.6, 2.5}, {0, 0.5, 0}, 40};
    Simulation simulation(scene, {.draw = true}, library_device());
    simulation.step();
    const std::optional<double> first = red_row(simulation.frame().rgba, 160);
    const double from = simulation.frame().bodies.at(0).position[1];
    for (int frame = 0; frame < 10; ++frame) simulation.step();
    const std::optional<double> last = red_row(simulation.frame().rgba, 160);
    const double way = from - simulation.frame().bodies.at(0).position[1];
    ASSERT_TRUE(first && last);
    // 120 rows show 2 x 2.5 tan 20 degrees at the target.
    EXPECT_NEAR(*last - *first, way * 120 / (5 * 0.36397), 4);
    EXPECT_GT(way, 0.1);
}

}  // namespace
}  // namespace drape
