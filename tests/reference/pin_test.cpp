// Pins are fixed, key-framed or released.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sheets.h"
#include "twin/twin.h"
#include "world/motion.h"

namespace drape {
namespace {

TEST(PinTest, AFixedParticleKeepsItsBits) {
    SceneDescription scene = test::sheet(8, 8, 0.7, 0.7, 8);
    scene.cloths[0].placement.origin = {0.1, 0.3, 0.7};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.wind.velocity = {3, 0, 4};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(twin.cloth(0)[Field::position][i].x, model.cloths[0].position[i].x);
        EXPECT_EQ(twin.cloth(0)[Field::position][i].y, model.cloths[0].position[i].y);
        EXPECT_EQ(twin.cloth(0)[Field::position][i].z, model.cloths[0].position[i].z);
    }
}

TEST(PinTest, AKeyFramedPinFollowsItsPathAboutItsPivot) {
    SceneDescription scene = test::sheet(6, 6, 0.5, 0.5, 8);
    scene.time.frame_count = 61;
    Pin pin = test::pin_box(0, 0, 5, 0);
    pin.path.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.2, -0.1, 0.3}, {0, 90, 20}}};
    pin.pivot = Vec3{0.1, 0, 0};
    scene.cloths[0].pins = {pin};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 40; ++frame) {
        twin.run_frame(frame);
        const RigidTransform motion = motion_at(pin.path, frame / 60.0);
        for (std::size_t column = 0; column < 6; ++column) {
            const Vec3 arm{0.1 * static_cast<double>(column) - 0.1, 0, 0};
            const glsl::vec4 at = twin.cloth(0)[Field::position][column];
            const double got[3] = {double(at.x), double(at.y), double(at.z)};
            for (std::size_t k = 0; k < 3; ++k) {
                const double pivot = k == 0 ? 0.1 : 0.0;
                const double expected = motion.rotation[3 * k] * arm[0] + pivot + motion.translation[k];
                EXPECT_NEAR(got[k], expected, 2e-7) << "frame " << frame << " column " << column;
            }
        }
    }
}

TEST(PinTest, AReleasedParticleKeepsItsVelocityAndThenFlies) {
    // End slopes are zero, so the middle key's velocity is (0.6 - 0)/(1 - 0) along x at t = 0.5, its acceleration -2.4.
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line})
        for (const std::uint32_t substeps : {1u, 16u}) {
            SceneDescription scene = test::sheet(4, 4, 0.3, 0.3, substeps);
            scene.solver.method = method;
            scene.time.frame_count = 121;
            Pin all = test::pin_box(0, 0, 3, 3);
            all.path.keys = {{0, {0, 0, 0}, {}}, {0.5, {0.3, 0, 0}, {}}, {1, {0.6, 0, 0}, {}}};
            all.release = 0.5;
            scene.cloths[0].pins = {all};
            const SimulationModel model(scene);
            Twin twin(model);
            for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
            // The line solver takes the velocity from the pin's rounded positions, and goes 3/4 of a h^2 too far.
            const bool is_line = method == SolverMethod::line;
            const double h = 1.0 / (60 * substeps), limit = is_line ? 10 * h * h + 5e-5 : 1e-5;
            for (std::size_t i = 0; i < 16; ++i) {
                const glsl::vec4 start = model.cloths[0].position[i], end = twin.cloth(0)[Field::position][i];
                EXPECT_EQ(end.w, model.cloths[0].free_weight[i]);
                EXPECT_NEAR(double(end.x) - double(start.x), 0.3 + 0.6 * 0.5, limit) << substeps;
                EXPECT_NEAR(double(end.y) - double(start.y), -0.5 * 9.81 * 0.25, limit) << substeps;
            }
        }
}

}  // namespace
}  // namespace drape
