// The estimate of the position error, and the difference between error and chaos, on runs whose truth is known.
#include "control/motion_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/byte_stream.h"
#include "control/frame_judgement.h"
#include "control/sensitivity.h"
#include "support/sheets.h"

namespace drape {
namespace {

const Method& line() { return row_of(SolverMethod::line); }
const Method& explicit_steps() { return row_of(SolverMethod::explicit_steps); }

TEST(MotionErrorTest, TheCompanionHasFewerSubstepsButOfExplicitStepsMore) {
    for (const std::uint32_t substeps : {2u, 4u, 6u, 8u, 12u, 16u, 96u, 4096u}) {
        EXPECT_GT(companion_substeps(line(), substeps), 0u);
        EXPECT_LE(companion_substeps(line(), substeps), substeps / 2);
    }
    EXPECT_EQ(companion_substeps(line(), 96), 24u);
    EXPECT_EQ(companion_substeps(line(), 8), 4u) << "longer substeps tell nothing in contact";
    EXPECT_EQ(companion_substeps(explicit_steps(), 40), 60u);
    // At the most that a loop takes there are no more.
    EXPECT_LT(companion_substeps(explicit_steps(), explicit_steps().most_substeps), explicit_steps().most_substeps);
}

TEST(MotionErrorTest, RichardsonsEstimateIsExactForAnErrorOfThatOrder) {
    EXPECT_LT(error_order(line(), true), error_order(line(), false)) << "changes of substeps leave less";
    for (const Method* method : {&line(), &explicit_steps()})
        for (const std::uint32_t substeps : {4u, 6u, 8u, 12u, 32u, 96u, 4096u}) {
            const double order = error_order(*method, substeps < 10);
            const auto error = [order](double n) { return 0.3 * std::pow(n, -order); };
            const std::uint32_t beside = companion_substeps(*method, substeps);
            const double apart = std::abs(error(beside) - error(substeps));
            EXPECT_NEAR(richardson_error(order, double(substeps) / beside, apart), error(substeps),
                        1e-9 * error(substeps))
                << method->name() << ", " << substeps;
        }
    EXPECT_EQ(richardson_error(1, 4, 0), 0);
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
    const auto estimate = [&](double apart) {
        return richardson_error(error_order(row_of(model.scene.solver.method), model.closed_loop()),
                                16.0 / model.companion_substeps(16), apart);
    };
    error.saw(25, 16, std::vector{0.01, 0.03});
    EXPECT_DOUBLE_EQ(error.error(), estimate(0.03));
    EXPECT_DOUBLE_EQ(error.share(),
                     std::max(estimate(0.01) / motion_limit(model, 0), estimate(0.03) / motion_limit(model, 1)) / 0.5);
    EXPECT_DOUBLE_EQ(error.allowed(), error.error() / error.share());
    EXPECT_DOUBLE_EQ(error.at_end(), 4 * error.error()) << "2 s, of which half a one has passed";
    const double before = error.error();
    error.saw(26, 16, std::vector{0.0, 0.0});
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
    const auto saw = [&](MotionError& error, double apart) { error.saw(frame, 16, std::vector{apart, 0.0}); };
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
