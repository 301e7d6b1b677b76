// Loads against Newton's laws, for every method: what pulls at cloth or presses on it is borne by pins, or accelerates
// it.
#include "support/loads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "reference/symplectic_reference.h"
#include "simulated.h"

namespace drape {
namespace {

using test::all_methods;
using test::by_method;
using test::expect_near;
using test::level_sheet;
using test::press;
using test::pull;
using test::Simulated;

constexpr IndexBox whole{{0, 0}, {8, 8}};

class LoadsTest : public testing::TestWithParam<SolverMethod> {};

/// A level sheet in a vacuum without gravity.
SceneDescription weightless(double damping) {
    SceneDescription scene = level_sheet(0, damping);
    scene.gravity = {0, 0, 0};
    return scene;
}

TEST_P(LoadsTest, PinsBearAWeightOnACornerToo) {
    SceneDescription scene = level_sheet(0, 12);
    Cloth& cloth = scene.cloths[0];
    cloth.placement.v = {0, -1, 0};
    cloth.stiffness = {false, 4000, 1000, 0};
    cloth.pins = {test::pin_top(cloth)};
    cloth.loads = {pull({{8, 8}, {8, 8}}, Vec3{0, -20, 0})};
    Simulated run(by_method(scene, GetParam(), 12));
    run.frames(240);
    expect_near(run.force("pins_0"), {0, run.weight() + 20, 0}, 1e-4, "the pins of a strip with a weight");
    expect_near(run.force("loads"), {0, -20, 0}, 1e-5, "the weight");
}

TEST_P(LoadsTest, AFreeSheetAcceleratesByForceOverMass) {
    for (const IndexBox& particles : {whole, IndexBox{{0, 0}, {8, 0}}, IndexBox{{3, 4}, {3, 4}}}) {
        SceneDescription scene = weightless(0);
        const Vec3 force{0.3, 0.1, -0.2};
        scene.cloths[0].loads = {pull(particles, force)};
        Simulated run(by_method(scene, GetParam(), 10));
        constexpr std::uint32_t frames = 12;
        const Vec3 before = run.statistics().center_of_mass;
        run.frames(frames);
        const double seconds = frames * run.frame_time();
        const ClothStatistics now = run.statistics();
        expect_near(now.momentum, times(seconds, force), 1e-4, "a free sheet's momentum");
        expect_near(minus(now.center_of_mass, before), times(0.5 * seconds * seconds / now.mass, force), 1e-3,
                    "the way of its centre of mass");
    }
}

TEST_P(LoadsTest, AForceWithKeysGivesItsIntegral) {
    SceneDescription scene = weightless(0);
    scene.cloths[0].loads = {pull(whole, std::vector<VectorKey>{{0.05, {0, 0, 0}}, {0.15, {0, 2, 0}}})};
    Simulated run(by_method(scene, GetParam(), 10));
    Vec3 given{};
    for (int frame = 0; frame < 12; ++frame) {
        run.frames(1);
        given = plus(given, times(run.frame_time(), run.force("loads")));
    }
    // In 0.2 s: 0.1 s at 1 N on average, then 0.05 s at 2 N. A substep takes the force at its middle, as it takes
    // gravity (weather_reference_test.cpp), so what it gained by then comes half a substep early or late.
    const double late = 2 * 0.5 * run.frame_time() / run.model().scene.solver.substeps;
    EXPECT_NEAR(given[1], 0.2, 1.01 * late);
    EXPECT_NEAR(run.statistics().momentum[1], 0.2, 1.01 * late);
    EXPECT_NEAR(run.statistics().momentum[1], given[1], 1e-6);
}

TEST_P(LoadsTest, PressureOnASheetHeldAllAroundIsPressureTimesItsArea) {
    SceneDescription scene = weightless(15);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.bend = 1e-4;
    cloth.pins = {test::pin_box(0, 0, 8, 0), test::pin_box(0, 8, 8, 8), test::pin_box(0, 1, 0, 7),
                  test::pin_box(8, 1, 8, 7)};
    cloth.loads = {press(whole, 50)};
    Simulated run(by_method(scene, GetParam(), 16));
    run.frames(150);
    // The front is the side of u x v, which is down here. The border is flat, so any bulge has the same area vector.
    expect_near(run.force("loads"), {0, -50 * 0.4 * 0.4, 0}, 1e-5, "pressure on a bulge");
    Vec3 borne{};
    for (const char* pins : {"pins_0", "pins_1", "pins_2", "pins_3"}) borne = plus(borne, run.force(pins));
    expect_near(borne, {0, 50 * 0.4 * 0.4, 0}, 1e-4, "what its four pins bear");
    const std::vector<glsl::vec4>& at = run.twin().cloth(0)[Field::position];
    EXPECT_LT(at[40].y, -0.005f) << "it bulges to its front";
    // Relaxation goes from spring to spring, one parity after the other: its stretch error is not symmetric.
    const float bound = GetParam() == SolverMethod::relax ? 0.03f * std::abs(at[40].y) : 1e-5f;
    for (std::size_t row = 0; row < 9; ++row)
        for (std::size_t column = 0; column < 9; ++column) {
            const float here = at[9 * row + column].y;
            EXPECT_NEAR(here, at[9 * row + 8 - column].y, bound) << column << ", " << row;
            EXPECT_NEAR(here, at[9 * (8 - row) + column].y, bound) << column << ", " << row;
        }
}

TEST_P(LoadsTest, WhatPullsAtHeldParticlesTheirPinBears) {
    SceneDescription scene = weightless(0);
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_box(0, 0, 0, 8), test::pin_box(8, 0, 8, 8)};
    cloth.loads = {pull({{8, 0}, {8, 8}}, Vec3{5, 0, 2})};
    Simulated run(by_method(scene, GetParam(), 4));
    run.frames(3);
    expect_near(run.force("pins_1"), {-5, 0, -2}, 1e-4, "the pin that is pulled at");
    EXPECT_LT(length(run.force("pins_0")), 1e-3);
    scene.cloths[0].loads.clear();
    Simulated unloaded(by_method(scene, GetParam(), 4));
    unloaded.frames(3);
    EXPECT_TRUE(std::ranges::equal(run.twin().cloth(0).bytes(Field::position),
                                   unloaded.twin().cloth(0).bytes(Field::position)));
}

/// Factors decide how a force is shared, and scale a pressure.
TEST_P(LoadsTest, AMapSharesAForceAndScalesAPressure) {
    SceneDescription scene = weightless(0);
    Cloth& cloth = scene.cloths[0];
    std::vector<float> left(81, 0.0f);
    for (std::size_t k = 0; k < 81; ++k) left[k] = k % 9 < 4 ? 1.0f : 0.0f;
    cloth.loads = {pull(whole, Vec3{0, 0.005, 0}), press(whole, 0.02)};
    for (Load& load : cloth.loads) load.factors = left;
    Simulated run(by_method(scene, GetParam(), 10));
    run.frames(1);
    // The left four columns have 3.5 of 8 columns' area.
    expect_near(run.force("loads"), {0, 0.005 - 0.02 * 0.16 * 3.5 / 8, 0}, 1e-4, "half of a sheet");
}

INSTANTIATE_TEST_SUITE_P(Methods, LoadsTest, testing::ValuesIn(all_methods),
                         [](const auto& each) { return std::string(named(each.param).name); });

/// A sheet held by its upper edge is pulled at a corner and pressed on; the twin comes to the exact motion.
TEST(LoadsReferenceTest, TheTwinComesToTheReference) {
    SceneDescription scene = test::sheet(9, 9, 0.5, 0.5, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_top(cloth)};
    cloth.stiffness = {false, 100, 20, 0};
    cloth.damping = 1;
    cloth.holes = {{{3, 3}, {5, 5}}};
    cloth.loads = {pull({{0, 8}, {4, 8}}, std::vector<VectorKey>{{0, {0, 0, 0}}, {0.2, {0.3, 0, 0.2}}}),
                   press(whole, 1.5)};
    scene.solver.method = SolverMethod::explicit_steps;
    const double times[] = {0.5};
    const std::vector<Vec3> exact = run_symplectic(SpringNetwork(scene, 0), times).states[0].position;
    double errors[2];
    for (int k = 0; k < 2; ++k) {
        scene.solver.substeps = k == 0 ? 64 : 128;
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
        double squares = 0;
        for (std::size_t p = 0; p < exact.size(); ++p) {
            const glsl::vec4& at = twin.cloth(0)[Field::position][p];
            const Vec3 off = minus(Vec3{double{at.x}, double{at.y}, double{at.z}}, exact[p]);
            squares += dot(off, off);
        }
        errors[k] = std::sqrt(squares / static_cast<double>(exact.size()));
    }
    std::printf("[ measured ] off by %.2e m with 64 substeps, %.2e m with 128\n", errors[0], errors[1]);
    EXPECT_LT(errors[1], 0.6 * errors[0]) << "of first order";
    EXPECT_LT(errors[1], 1e-3);
}

}  // namespace
}  // namespace drape
