// Some frames are no results, and a run of several cloths names the worst of all cloths, not of the first.
#include "simulation/frame_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "output/temporary_folder.h"
#include "run/run_statistics.h"
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
    const TemporaryFolder temporary;
    OutputFolder folder(temporary / "out");
    RunStatistics run(&folder);
    const auto add = [&](std::uint32_t number, double first, double second) {
        FinishedFrame frame;
        frame.frame = number;
        frame.statistics.resize(2);
        for (std::size_t k = 0; k < 2; ++k) {
            frame.statistics[k].stretch = {10, k == 0 ? first : second, 0, 0};
            frame.statistics[k].stretch_error_rms = k == 0 ? first : second;
            frame.statistics[k].penetration = k == 0 ? first : second;
        }
        const FrameValues values = frame_values(scene, frame);
        run.add(number, values);
        return run.note(values);
    };
    EXPECT_THAT(add(0, 0.01, 0.03), HasSubstr("stretch error 3 % RMS"));
    EXPECT_THAT(add(1, 0.05, 0.02), AllOf(HasSubstr("stretch error 5 % RMS"), HasSubstr("penetration 50 mm")));
    add(2, 0.01, 0.01);
    EXPECT_THAT(add(3, 0, 0), HasSubstr("no penetration"));
    EXPECT_THAT(add(4, 0, 5e-7), HasSubstr("penetration below 0.001 mm"));
    EXPECT_EQ(run.worst_of_run("/stretch_error_rms"), 0.05);
    std::vector<double> depths;
    run.for_each_frame([&](const auto& each) { depths.push_back(each.values.at("penetration_m")); });
    EXPECT_THAT(depths, testing::ElementsAre(0.03, 0.05, 0.01, 0, 5e-7));
}

// Frames of an earlier run come first, then those between; the drift is from the first of all.
TEST(RunStatisticsTest, EnergyDriftIsFromTheFirstFrameThatThereIs) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary / "out");
    RunStatistics run(&folder);
    run.add(3, {{"energy_j", 7}});
    run.add(1, {{"energy_j", 5}});
    run.add(2, {{"energy_j", 4}});
    std::vector<std::pair<std::int64_t, double>> drifts;
    run.for_each_frame([&](const auto& each) { drifts.emplace_back(each.frame, each.values.at("energy_drift_j")); });
    EXPECT_THAT(drifts, testing::ElementsAre(std::pair(1, 0.0), std::pair(2, -1.0), std::pair(3, 2.0)));
    EXPECT_THAT(run.note({{"energy_j", 6}}), HasSubstr("energy +1 J since frame 1"));
}

// A stream has no manifest.
TEST(RunStatisticsTest, WithoutAFolderOnlyTheWorstIsKept) {
    RunStatistics run(nullptr);
    run.add(0, {{"sheet/stretch_error_rms", 0.5}});
    EXPECT_EQ(run.worst_of_run("/stretch_error_rms"), 0.5);
    run.for_each_frame([](const auto&) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace drape
