// Every simulation pass on the device equals its C++ twin bit for bit (lavapipe), over more than 200 substeps.
#include <gtest/gtest.h>

#include <cmath>

#include "device_run.h"
#include "gpu_test.h"
#include "reference/twin.h"
#include "support/sheets.h"

namespace drape {
namespace {

using test::DeviceRun;

constexpr std::uint32_t frame_count = 18, substep_count = 12;  // 216 substeps

Colliders four_moving_colliders() {
    const MotionPath path{{{0, {0, 0, 0}, {0, 0, 0}}, {0.3, {0.05, 0.1, 0}, {20, 90, 10}}}};
    Colliders colliders;
    colliders.planes.emplace_back();
    colliders.planes[0].offset = -0.4;
    colliders.planes[0].normal = {0, 1, 0};
    colliders.planes[0].path = path;
    colliders.spheres.emplace_back();
    colliders.spheres[0].center = {-0.2, -0.25, 0.1};
    colliders.spheres[0].radius = 0.2;
    colliders.spheres[0].path = path;
    colliders.spheres.push_back(colliders.spheres[0]);
    colliders.spheres[1].center = {0.1, -0.3, 0.3};
    colliders.spheres[1].path = {};
    colliders.boxes.emplace_back();
    colliders.boxes[0].center = {0.3, -0.2, -0.1};
    colliders.boxes[0].half_extents = {0.1, 0.15, 0.2};
    colliders.boxes[0].rotate = {10, 20, 30};
    colliders.boxes[0].path = path;
    colliders.ellipsoids.emplace_back();
    colliders.ellipsoids[0].center = {0, -0.2, -0.3};
    colliders.ellipsoids[0].radii = {0.3, 0.15, 0.1};
    colliders.ellipsoids[0].rotate = {0, 40, 0};
    colliders.ellipsoids[0].path = path;
    return colliders;
}

/// Everything at once: pins of all sorts, wind with gusts, all colliders moving, friction, damping.
SceneDescription everything() {
    SceneDescription scene = test::sheet(37, 30, 1.1, 0.9, substep_count, 1);
    scene.time.frame_count = frame_count + 1;
    scene.wind.velocity = {2, 0.5, -1};
    scene.wind.gust = {1.5, 0.2, 7};
    scene.colliders = four_moving_colliders();
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.55, 0.0, -0.45}, {1, 0, 0}, {0, 0, 1}};
    cloth.stiffness = {false, 800, 60, 0};
    cloth.damping = 0.7;
    cloth.velocity = {0.3, -1.5, 0.2};
    Pin moving = test::pin_box(0, 0, 4, 0);
    moving.path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0.1, 0.05, 0}, {0, 30, 10}}};
    Pin released = test::pin_box(36, 0, 36, 3);
    released.release = 0.11;
    cloth.pins = {moving, released, test::pin_box(18, 0, 18, 0)};
    return scene;
}

void expect_same(const char* what, const std::vector<glsl::vec4>& device, const std::vector<glsl::vec4>& twin,
                 std::uint32_t frame) {
    std::string where;
    EXPECT_TRUE(test::same_bits(device, twin, where)) << what << " after frame " << frame << ": " << where;
}

void compare(const SceneDescription& scene, const ModelOptions& options = {}) {
    const SimulationModel model(scene, options);
    Twin twin(model);
    DeviceRun device(test::gpu().device, model);
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        twin.run_frame(frame);
        device.run_frame(frame);
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
            twin.normals(cloth);
            const TwinCloth& expected = twin.cloth(cloth);
            expect_same("position", device.image(cloth, "position"), expected.position, frame);
            expect_same("displacement", device.image(cloth, "displacement"), expected.displacement, frame);
            expect_same("position rest", device.image(cloth, "position rest"), expected.position_rest, frame);
            expect_same("displacement rest", device.image(cloth, "displacement rest"), expected.displacement_rest,
                        frame);
            expect_same("normal", device.normals(cloth), expected.normal, frame);
            for (std::size_t direction = 0; direction < 4; ++direction) {
                if (model.cloths[cloth].multiplied[direction]) {
                    EXPECT_EQ(device.multiplier(cloth, direction), expected.multiplier[direction]);
                }
            }
        }
        if (testing::Test::HasFailure()) return;
    }
    // The comparison means something only if the cloth moved and stayed finite.
    double moved = 0;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
        const glsl::vec4 a = model.cloths[0].position[i], b = twin.cloth(0).position[i];
        ASSERT_TRUE(std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.z));
        moved = std::max(moved, std::abs(double(b.y) - double(a.y)));
    }
    EXPECT_GT(moved, 0.01);
}

TEST(TwinTest, EverythingAtOnce) { compare(everything()); }

TEST(TwinTest, IteratedCompliantSpringsWithMultipliers) {
    SceneDescription scene = everything();
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

TEST(TwinTest, PlainHangingSheet) {
    SceneDescription scene = test::sheet(65, 33, 1, 0.5, substep_count);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cloths[0].stiffness = {false, 50, 5, 0};
    compare(scene);
}

TEST(SkipTest, ExactSkipsChangeNoBit) {
    SceneDescription scene = everything();
    const SimulationModel lean(scene), full(scene, {.skip = false});
    DeviceRun skipping(test::gpu().device, lean), keeping(test::gpu().device, full);
    EXPECT_FALSE(skipping.pool().has("sheet/stiffness"));
    EXPECT_TRUE(keeping.pool().has("sheet/stiffness"));
    EXPECT_FALSE(skipping.pool().has("sheet/multiplier row"));
    EXPECT_TRUE(keeping.pool().has("sheet/multiplier row"));
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        skipping.run_frame(frame);
        keeping.run_frame(frame);
    }
    expect_same("position", skipping.image(0, "position"), keeping.image(0, "position"), frame_count);
    expect_same("normal", skipping.normals(0), keeping.normals(0), frame_count);
}

TEST(SkipTest, WhatASceneDoesNotNeedDoesNotExist) {
    SceneDescription scene = test::sheet(16, 16, 1, 1, 4);
    const SimulationModel model(scene);
    const DeviceRun run(test::gpu().device, model);
    for (const char* name : {"wind", "sheet/wind force", "sheet/stiffness", "sheet/cells", "sheet/multiplier row",
                             "sheet/pinned particles", "sheet/pin motions", "colliders/spheres", "sheet/triangles"})
        EXPECT_FALSE(run.pool().has(name)) << name;
    EXPECT_TRUE(run.pool().has("sheet/position"));
    // force (two variants), springs (one), advance, normals
    EXPECT_EQ(run.solver().pipeline_count(), 5u);
}

TEST(DeterminismTest, TwoRunsGiveTheSameBits) {
    const SceneDescription scene = everything();
    const SimulationModel model(scene);
    DeviceRun first(test::gpu().device, model), second(test::gpu().device, model);
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) first.run_frame(frame);
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) second.run_frame(frame);
    expect_same("position", first.image(0, "position"), second.image(0, "position"), frame_count);
    expect_same("normal", first.normals(0), second.normals(0), frame_count);
}

TEST(CanaryTest, AMissingBarrierBetweenSpringPassesIsReported) {
    const SceneDescription scene = everything();
    const SimulationModel model(scene);
    test::ExpectValidationMessages expected;
    DeviceRun run(test::gpu().device, model, [](const graph::PlannedPass&, const graph::Barrier& barrier) {
        return barrier.reason.find("spring column odd") == std::string::npos;
    });
    run.run_frame(1);
    EXPECT_FALSE(expected.messages().empty());
}

}  // namespace
}  // namespace drape
