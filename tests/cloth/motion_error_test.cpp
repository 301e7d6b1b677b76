// The estimate of the position error, and the difference between error and chaos, on runs whose truth is known.
#include "cloth/motion_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/byte_stream.h"
#include "cloth/frame_judgement.h"
#include "cloth/sensitivity.h"
#include "support/sheets.h"

namespace drape {
namespace {

const Method& line() { return row_of(SolverMethod::line); }
const Method& explicit_steps() { return row_of(SolverMethod::explicit_steps); }

TEST(MotionErrorTest, CompanionsHaveFewerSubstepsButOfExplicitStepsMore) {
    for (const std::uint32_t substeps : {2u, 4u, 6u, 8u, 12u, 16u, 96u, 4096u}) {
        const Companions with = companions_of(line(), substeps);
        EXPECT_GT(with.companion, 0u);
        EXPECT_LT(with.companion, substeps);
        EXPECT_GT(with.coarser, 0u) << "a run that is left out for some frames is behind the others for ever";
        EXPECT_EQ(with.coarser<with.companion, substeps> 2) << substeps;
        EXPECT_GT(companions_of(explicit_steps(), 40).companion, 40u);
    }
    // At the most that a loop takes there are no more.
    EXPECT_LT(companions_of(explicit_steps(), explicit_steps().most_substeps).companion,
              explicit_steps().most_substeps);
}

TEST(MotionErrorTest, RichardsonsEstimateIsExactForAnErrorOfOneOrder) {
    const double constant = 0.3;
    for (const double order : {0.7, 1.0, 1.5, 2.0, 3.0})
        for (const std::uint32_t substeps : {4u, 6u, 8u, 12u, 32u, 96u}) {
            const auto error = [&](double n) { return constant * std::pow(n, -order); };
            const Companions with = companions_of(line(), substeps);
            const double apart = error(with.companion) - error(substeps),
                         further = error(with.coarser) - error(with.companion);
            EXPECT_NEAR(richardson_error(step_ratios(with, substeps), apart, further), error(substeps),
                        1e-6 * error(substeps))
                << order << ", " << substeps;
        }
    EXPECT_EQ(richardson_error({4, 8}, 0, 0), 0);
}

TEST(MotionErrorTest, WithoutACoarserRunTheOrderIsTheUsualOne) {
    const auto error = [](double n) { return std::pow(n, -1.4); };
    const Companions more = companions_of(explicit_steps(), 40);
    EXPECT_NEAR(richardson_error(step_ratios(more, 40), error(40) - error(more.companion), 0), error(40), 1e-9);
}

/// Two cloths, the second twice the size: its error may be twice as large.
SceneDescription two_cloths() {
    SceneDescription scene = test::sheet(9, 8, 1, 0.5, 1);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].size = {2, 1};
    scene.time = {.fps = 50, .frame_count = 101};
    scene.solver = {};
    return scene;
}

TEST(MotionErrorTest, TheWorstClothCountsAndAnErrorHoldsOn) {
    const SimulationModel model(two_cloths());
    MotionError error(model);
    EXPECT_TRUE(std::isnan(error.error()));
    const Companions with = model.companions(16);
    const std::vector<double> further(with.coarser > 0 ? 2 : 0, 0.02);
    const auto estimate = [&](double apart) {
        return richardson_error(step_ratios(with, 16), apart, further.empty() ? 0 : 0.02);
    };
    error.saw(25, 16, std::vector{0.01, 0.03}, further);
    EXPECT_DOUBLE_EQ(error.error(), estimate(0.03));
    EXPECT_DOUBLE_EQ(error.share(),
                     std::max(estimate(0.01) / motion_limit(model, 0), estimate(0.03) / motion_limit(model, 1)) / 0.5);
    EXPECT_DOUBLE_EQ(error.allowed(), error.error() / error.share());
    EXPECT_DOUBLE_EQ(error.at_end(), 4 * error.error()) << "2 s, of which half a one has passed";
    const double before = error.error();
    error.saw(26, 16, std::vector{0.0, 0.0}, further);
    EXPECT_LT(error.error(), before);
    EXPECT_GT(error.error(), 0.9 * before) << "a swing's two runs meet for a moment";
    ByteWriter writer;
    error.transfer(writer);
    MotionError other(model);
    const std::vector<std::byte> bytes = writer.take();
    ByteReader reader(bytes);
    EXPECT_TRUE(other.transfer(reader));
    EXPECT_EQ(other.error(), error.error());
    EXPECT_EQ(other.share(), error.share());
}

/// An error that is `share` of what is allowed at that frame.
MotionError error_of(const SimulationModel& model, std::uint32_t frame, double share) {
    MotionError unit(model);
    const Companions with = model.companions(16);
    const auto saw = [&](MotionError& error, double apart) {
        error.saw(frame, 16, std::vector{apart, 0.0}, std::vector<double>(with.coarser > 0 ? 2 : 0, apart));
    };
    saw(unit, 1);
    MotionError error(model);
    saw(error, share / unit.share());
    return error;
}

TEST(SensitivityTest, ARunThatPartsAsFarAsTheErrorIsSensitive) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    EXPECT_FALSE(sensitivity.begins(10, error_of(model, 10, 0.6), true));
    const MotionError error = error_of(model, 10, 0.8);
    ASSERT_TRUE(sensitivity.begins(10, error, true));
    sensitivity.begin(10);
    sensitivity.saw(11, std::vector{0.05 * error.error(), 0.0}, error);
    EXPECT_FALSE(sensitivity.is_sensitive());
    EXPECT_TRUE(sensitivity.runs());
    sensitivity.saw(12, std::vector{0.0, 0.9 * error.error()}, error);
    EXPECT_TRUE(sensitivity.is_sensitive());
    EXPECT_FALSE(sensitivity.runs());
    EXPECT_FALSE(sensitivity.begins(500, error, true)) << "it is known";
    EXPECT_DOUBLE_EQ(sensitivity.parted(), 0.9 * error.error());
}

TEST(SensitivityTest, AnErrorThatSubstepsDoNotReduceIsLookedInto) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    const MotionError small = error_of(model, 10, 0.01);
    EXPECT_FALSE(sensitivity.begins(10, small, true));
    ASSERT_TRUE(sensitivity.begins(10, small, false));
    sensitivity.begin(10);
    sensitivity.saw(11, std::vector{small.error(), 0.0}, small);
    EXPECT_FALSE(sensitivity.is_sensitive()) << "runs that part by less than matters";
    sensitivity.saw(12, std::vector{0.1 * small.allowed(), 0.0}, small);
    EXPECT_TRUE(sensitivity.is_sensitive());
}

TEST(SensitivityTest, ARunThatDoesNotPartEndsAndMayBeginAgainLater) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    sensitivity.begin(10);
    std::uint32_t frame = 10;
    while (sensitivity.runs() && frame < 1000) {
        ++frame;
        sensitivity.saw(frame, std::vector{1e-6, 1e-6}, error_of(model, frame, 2));
    }
    EXPECT_EQ(frame, 61u) << "a second, at 50 frames per second";
    EXPECT_FALSE(sensitivity.is_sensitive());
    EXPECT_FALSE(sensitivity.begins(frame + 50, error_of(model, frame + 50, 2), true));
    EXPECT_TRUE(sensitivity.begins(frame + 150, error_of(model, frame + 150, 2), true));
}

}  // namespace
}  // namespace drape
