// Every simulation pass on the device equals its C++ twin bit for bit (lavapipe), over more than 200 substeps.
#include <gtest/gtest.h>

#include <random>

#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;
using test::DeviceRun;
using test::everything;
using test::expect_same;
using test::frame_count;
using test::substep_count;

TEST(TwinTest, EverythingAtOnce) { compare(everything()); }

/// Wind and gravity change within the frames, with wind and without, over holes, and of cloths of unlike masses.
TEST(TwinTest, WeatherThatChanges) {
    SceneDescription scene = everything();
    scene.gravity_keys = {{0.02, {0, -9.81, 0}}, {0.1, {6, -2, 1}}, {0.25, {-4, 3, 0}}};
    scene.wind.keys = {{0, {2, 0, 0}}, {0.08, {0, 0, 0}}, {0.2, {-3, 1, 6}}};
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::line, SolverMethod::explicit_steps}) {
        scene.solver.method = method;
        compare(scene);
        SceneDescription airless = scene;
        airless.wind = {};
        airless.colliders.clear();
        airless.cloths[0].holes = {{{10, 5}, {20, 12}}};
        test::add_second_cloth(airless);
        airless.cloths[1].areal_density *= 3;
        compare(airless);
    }
}

TEST(TwinTest, IteratedCompliantSpringsThatCarryTheirTension) {
    SceneDescription scene = everything();
    scene.solver.iterations = 3;
    compare(scene);
}

TEST(TwinTest, SpringsSoftInCompressionIterated) {
    SceneDescription scene = everything();
    scene.cloths[0].stiffness.compression = 0.1;
    compare(scene);
    scene.solver.iterations = 3;
    compare(scene);
}

TEST(TwinTest, RigidSpringsIterated) {
    SceneDescription scene = everything();
    scene.cloths[0].stiffness.rigid = true;
    scene.solver.iterations = 2;
    scene.solver.collide = CollideWhen::substep;
    compare(scene);
}

TEST(TwinTest, MoreCollidersThanAreReadEarly) {
    SceneDescription scene = everything();
    for (int k = 0; k < 6; ++k)
        scene.colliders.push_back({Sphere{{-0.5 + 0.2 * k, -0.15 - 0.02 * k, 0.2 - 0.1 * k}, 0.05}});
    compare(scene);
}

/// Some colliders of every kind come after the early ones, in more than one group of 32.
TEST(TwinTest, ManyCollidersOfEveryKind) {
    SceneDescription scene = everything();
    std::mt19937 random(3);
    const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    for (int k = 0; k < 60; ++k) {
        const Vec3 at{uniform(-0.7, 0.7), uniform(-0.5, 0), uniform(-0.7, 0.7)};
        const ColliderShape shapes[] = {Sphere{at, 0.05}, Box{at, {0.05, 0.03, 0.06}},
                                        Ellipsoid{at, {0.04, 0.05, 0.06}},
                                        Capsule{at, {at[0] + 0.1, at[1], at[2]}, {0.03, 0.04}}};
        scene.colliders.push_back({shapes[k % 4], 0.3, {uniform(0, 90), uniform(0, 90), 0}});
    }
    compare(scene);
    scene.solver.method = SolverMethod::line;
    compare(scene);
}

/// Thin ones that cloth goes through in a substep if its way does not count, early and late, at rest and moving.
TEST(TwinTest, ThinCollidersOfEveryKindOnALongWay) {
    for (const int count : {4, 8}) {
        SceneDescription scene = everything();
        scene.gravity = {0, -400, 0};
        std::mt19937 random(4);
        const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
        for (int k = 0; k < count; ++k) {
            const Vec3 at{uniform(-0.5, 0.5), uniform(-1, -0.1), uniform(-0.5, 0.5)};
            const ColliderShape shapes[] = {Box{at, {0.3, 0.001, 0.2}}, Sphere{at, 0.01},
                                            Ellipsoid{at, {0.2, 0.002, 0.2}},
                                            Capsule{at, {at[0] + 0.4, at[1], at[2]}, {0.001, 0.02}}};
            Collider thin{shapes[k % 4], 0.3, {uniform(0, 40), 0, uniform(0, 40)}};
            if (k % 3 == 0) thin.path = {{{0, {0, 0, 0}, {0, 0, 0}}, {0.1, {0, 1.5, 0}, {50, 20, 0}}}};
            scene.colliders.push_back(thin);
        }
        if (count == 8) scene.solver.method = SolverMethod::line;
        compare(scene);
    }
}

TEST(TwinTest, HolesAndTwoCloths) {
    SceneDescription scene = everything();
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

/// Over 64 of 1024 particles each (Pipelines::over_strips): a second row of workgroups.
TEST(TwinTest, MoreWorkgroupsThanStandBesideEachOther) {
    SceneDescription scene = test::thrown_sheet({263, 255}, 1);
    scene.solver.tethers = true;
    compare(scene);
    scene.solver.method = SolverMethod::line;
    compare(scene);
}

TEST(TwinTest, Bending) {
    SceneDescription scene = everything();
    scene.cloths[0].stiffness.bend = 1e-4;
    scene.solver.iterations = 2;
    compare(scene);
}

TEST(TwinTest, BendingWithHoles) {
    SceneDescription scene = everything();
    scene.cloths[0].stiffness.bend = 1e-3;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}, {{25, 15}, {26, 16}}};
    compare(scene);
}

TEST(TwinTest, GatheredOnAPointAndScattered) {
    SceneDescription scene = everything();
    scene.cloths[0].placement.scale = {0, 0};
    compare(scene);
    scene.cloths[0].placement.scale = {0.8, 1.3};
    scene.cloths[0].placement.jitter = 0.01;
    compare(scene);
}

TEST(TwinTest, PlainHangingSheet) {
    SceneDescription scene = test::sheet(65, 33, 1, 0.5, substep_count);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cloths[0].stiffness = {false, 50, 5, 0};
    compare(scene);
}

TEST(SkipTest, ExactSkipsChangeNoBit) {
    SceneDescription scene = everything();
    std::erase_if(scene.cloths[0].pins, [](const Pin& pin) { return pin.release.has_value(); });  // needs the tension
    const SimulationModel lean(scene), full(scene, {.skip = false});
    DeviceRun skipping(test::gpu().device, lean), keeping(test::gpu().device, full);
    EXPECT_FALSE(skipping.pool().has("sheet/spring shares"));
    EXPECT_TRUE(keeping.pool().has("sheet/spring shares"));
    EXPECT_FALSE(skipping.pool().has("sheet/tension row"));
    EXPECT_TRUE(keeping.pool().has("sheet/tension row"));
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        skipping.run_frame(frame);
        keeping.run_frame(frame);
    }
    expect_same(Field::position, skipping, keeping, frame_count);
    expect_same(Field::normal, skipping, keeping, frame_count);
}

TEST(SkipTest, WhatASceneDoesNotNeedDoesNotExist) {
    SceneDescription scene = test::sheet(16, 16, 1, 1, 4);
    const SimulationModel model(scene);
    const DeviceRun run(test::gpu().device, model);
    for (const char* name : {"wind", "sheet/wind force", "sheet/spring shares", "sheet/cells", "sheet/tension row",
                             "sheet/pinned particles", "sheet/pin motions", "colliders", "sheet/triangles"})
        EXPECT_FALSE(run.pool().has(name)) << name;
    EXPECT_TRUE(run.pool().has("sheet/position"));
    // force (two variants), springs (one), torque, rotate (two variants), advance, normals
    EXPECT_EQ(run.solver().pipeline_count(), 8u);
}

TEST(DeterminismTest, TwoRunsGiveTheSameBits) {
    const SceneDescription scene = everything();
    const SimulationModel model(scene);
    DeviceRun first(test::gpu().device, model), second(test::gpu().device, model);
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) first.run_frame(frame);
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) second.run_frame(frame);
    expect_same(Field::position, first, second, frame_count);
    expect_same(Field::normal, first, second, frame_count);
}

TEST(CanaryTest, AMissingBarrierBetweenSpringPassesIsReported) {
    const SceneDescription scene = everything();
    const SimulationModel model(scene);
    test::ExpectValidationMessages expected;
    DeviceRun run(
        test::gpu().device, model,
        [](const graph::PlannedPass&, const graph::Barrier& barrier) {
            return barrier.reason.find("spring column odd") == std::string::npos;
        },
        Kernels{test::layer_sees_shared_memory() ? Kernel::buffer_store : Kernel::plain});
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
