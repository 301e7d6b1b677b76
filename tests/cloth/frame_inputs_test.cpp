// The host hands the device its inputs for each substep of a frame.
#include "cloth/frame_inputs.h"

#include <gtest/gtest.h>

#include "scene/gust.h"
#include "support/sheets.h"

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

}  // namespace
}  // namespace drape
