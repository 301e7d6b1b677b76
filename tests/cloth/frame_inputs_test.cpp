// The host hands the device its inputs for each substep of a frame.
#include "cloth/frame_inputs.h"

#include <gtest/gtest.h>

#include "support/sheets.h"
#include "world/gust.h"

namespace drape {
namespace {

/// A substep of second order takes forces at its middle.
TEST(FrameInputs, TheWindOfASubstepIsThatOfItsMiddle) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 4);
    scene.wind.velocity = {3, 0, 4};
    scene.wind.gust.amplitude = 2;
    scene.wind.gust.period = 0.1;
    const SimulationModel model(scene);
    for (const std::uint32_t frame : {1u, 2u, 7u}) {
        const FrameInputs inputs = frame_inputs(model, frame);
        ASSERT_EQ(inputs.wind.size(), 4u);
        for (std::size_t substep = 0; substep < inputs.wind.size(); ++substep) {
            const double middle = (frame - 1 + (static_cast<double>(substep) + 0.5) / 4) / scene.time.fps;
            const double speed = 5 + gust_speed(scene.wind.gust, middle);
            EXPECT_NEAR(static_cast<double>(inputs.wind[substep].x), 0.6 * speed, 1e-6) << frame << ", " << substep;
            EXPECT_EQ(inputs.wind[substep].y, 0);
            EXPECT_NEAR(static_cast<double>(inputs.wind[substep].z), 0.8 * speed, 1e-6) << frame << ", " << substep;
        }
    }
}

TEST(FrameInputs, GravityThatChangesFollowsTheWindOfASubstep) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 4);
    scene.gravity_keys = {{0, {0, -10, 0}}, {1, {2, 0, 5}}};
    const SimulationModel model(scene);
    ASSERT_TRUE(model.windy && model.weighs);
    EXPECT_EQ(model.cloths[0].wind.drag_coefficient, 0) << "there is no air";
    for (const std::uint32_t frame : {1u, 7u, 90u}) {
        const FrameInputs inputs = frame_inputs(model, frame);
        ASSERT_EQ(inputs.wind.size(), 8u);
        for (std::size_t substep = 0; substep < 4; ++substep) {
            const double middle = (frame - 1 + (static_cast<double>(substep) + 0.5) / 4) / scene.time.fps;
            const glsl::vec4 blows = inputs.wind[2 * substep], more = inputs.wind[2 * substep + 1];
            const double share = std::min(middle, 1.0);
            EXPECT_EQ(blows.x, 0);
            EXPECT_NEAR(double(more.x), 2 * share, 1e-6);
            EXPECT_NEAR(double(more.y), 10 * share, 1e-6);
            EXPECT_NEAR(double(more.z), 5 * share, 1e-6);
        }
    }
    scene.gravity_keys[1].value = scene.gravity_keys[0].value;
    EXPECT_FALSE(SimulationModel(scene).windy) << "nothing changes";
}

}  // namespace
}  // namespace drape
