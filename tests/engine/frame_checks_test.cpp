// What makes a frame no result, and what a run of several cloths says of the worst: of all cloths, not the first.
#include "frame_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_statistics.h"
#include "support/sheets.h"

namespace drape {
namespace {

using testing::HasSubstr;

SceneDescription two_sheets() {
    SceneDescription scene = test::sheet(4, 3, 1, 1, 4);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    scene.cloths[1].grid = {5, 3};
    scene.cloths[1].placement.origin = {3, 0, 0};
    scene.solver.tolerance = 0.1;
    return scene;
}

std::optional<FrameFailure> failure(const SimulationModel& model, std::uint32_t number,
                                    const std::vector<ClothStatistics>& cloths) {
    Watch watch(model);
    FinishedFrame frame;
    frame.frame = number;
    frame.statistics = cloths;
    return frame_failure(model, watch, frame);
}

TEST(FrameChecks, EveryClothIsLookedAtForWhatIsNotFinite) {
    const SimulationModel model(two_sheets());
    std::vector<ClothStatistics> cloths(2);
    EXPECT_FALSE(failure(model, 7, cloths));
    cloths[1].non_finite_count = 2;
    cloths[1].first_non_finite = 7;
    ASSERT_TRUE(failure(model, 7, cloths));
    EXPECT_THAT(
        failure(model, 7, cloths)->reason,
        HasSubstr("in frame 7, cloth 'second', the particle in column 2, row 1 is not finite (2 of the cloth's 15"));
    cloths[0].non_finite_count = 1;
    EXPECT_THAT(failure(model, 7, cloths)->reason, HasSubstr("cloth 'sheet', the particle in column 0, row 0"));
}

TEST(FrameChecks, TheToleranceIsTheScenesAndEveryCloths) {
    const SimulationModel model(two_sheets());
    std::vector<ClothStatistics> cloths(2);
    cloths[0].stretch_error_rms = cloths[1].stretch_error_rms = 0.0999;
    EXPECT_FALSE(failure(model, 3, cloths));
    cloths[1].stretch_error_rms = 0.101;
    ASSERT_TRUE(failure(model, 3, cloths));
    EXPECT_THAT(failure(model, 3, cloths)->reason, HasSubstr("in frame 3, cloth 'second', the stretch"));
}

TEST(RunStatisticsTest, TheWorstIsTheLargestOfAnyClothAndFrame) {
    const SceneDescription scene = two_sheets();
    RunStatistics run;
    const auto add = [&](std::uint32_t number, double first, double second) {
        FinishedFrame frame;
        frame.frame = number;
        frame.statistics.resize(2);
        for (std::size_t k = 0; k < 2; ++k) {
            frame.statistics[k].stretch = {10, k == 0 ? first : second, 0, 0};
            frame.statistics[k].stretch_error_rms = k == 0 ? first : second;
            frame.statistics[k].penetration = k == 0 ? first : second;
        }
        run.add(number, frame_values(scene, frame));
    };
    add(0, 0.01, 0.03);
    add(1, 0.05, 0.02);
    add(2, 0.01, 0.01);
    add(3, 0, 0);
    add(4, 0, 5e-7);
    EXPECT_EQ(run.worst_of_run("/stretch_error_rms"), 0.05);
    EXPECT_THAT(run.note(0), HasSubstr("stretch error 3 % RMS"));
    EXPECT_THAT(run.note(1), HasSubstr("stretch error 5 % RMS"));
    EXPECT_THAT(run.note(1), HasSubstr("penetration 50 mm"));
    EXPECT_THAT(run.note(3), HasSubstr("no penetration"));
    EXPECT_THAT(run.note(4), HasSubstr("penetration below 0.001 mm"));
    EXPECT_EQ(run.frames()[1].values.at("penetration_m"), 0.05);
}

}  // namespace
}  // namespace drape
