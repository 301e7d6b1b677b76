// Results of trials of `auto` come back whole, and their judgement and text are right.
#include "bench/trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drape::bench {
namespace {

using testing::HasSubstr;
using testing::Not;

TrialResult scene_result(const std::string& name) {
    TrialResult result;
    result.name = name;
    result.key = "key of " + name;
    result.method = "line";
    result.best = "line/8";
    result.tags = {"wind", "release"};
    result.numbers = {{"frames", 30},
                      {"wall_s", 3},
                      {"worst_stretch_error", 0.008},
                      {"worst_spring", 0.05},
                      {"tolerance", 0.01},
                      {"missed_frames", 0},
                      {"best_wall_s", 1.5},
                      {"stated_error", 0.02},
                      {"error_at_end", 0.01},
                      {"reference_error", 0.001}};
    return result;
}

TEST(TrialTest, ALineGivesBackEverything) {
    TrialResult result = scene_result("b/1/7");
    result.outcome = TrialOutcome::tolerance;
    result.reason = "in frame 3, \"cloth\"";
    result.numbers["worst_spring"] = INFINITY;
    const std::string line = json_line(json_of(result));
    EXPECT_THAT(line, Not(HasSubstr("\n")));
    EXPECT_EQ(parsed_result<TrialResult>(line), result);
    EXPECT_FALSE(parsed_result<TrialResult>(line.substr(0, line.size() - 5)));
    EXPECT_FALSE(parsed_result<TrialResult>("{}"));
}

TEST(TrialTest, OnePerCentMayBeRefusedButNothingSilently) {
    std::vector<TrialResult> results(200, scene_result("b/1/0"));
    results[1].outcome = TrialOutcome::tolerance;
    results[2].outcome = TrialOutcome::diverged;
    EXPECT_FALSE(trial_fails(results));
    results[3].outcome = TrialOutcome::failed;
    EXPECT_TRUE(trial_fails(results));
    results.assign(200, scene_result("b/1/0"));
    results[7].numbers["missed_frames"] = 1;
    EXPECT_TRUE(trial_fails(results));
    EXPECT_FALSE(trial_fails({}));
}

TEST(TrialTest, TheTextSaysWhatHappened) {
    std::vector<TrialResult> results(5, scene_result("b/1/0"));
    results[1].outcome = TrialOutcome::tolerance;
    results[1].name = "b/1/1";
    results[1].reason = "the ladder ends";
    results[2].name = "b/1/2";
    results[2].numbers["missed_frames"] = 5;
    results[2].numbers["worst_stretch_error"] = 0.2;
    results[3].numbers["reference_error"] = 0.009;  // too small to tell the true error well
    results[4].outcome = TrialOutcome::impossible;
    const std::string text = trial_text(results);
    EXPECT_THAT(text, HasSubstr("b/1/1 tolerance missed: the ladder ends\n"));
    EXPECT_THAT(text,
                HasSubstr("b/1/2 silently missed in 5 of 30 frames: stretch error 0.2 of 0.01, worst spring 0.05\n"));
    EXPECT_THAT(text, HasSubstr("5 scenes: 60.0 % kept, 20.0 % refused, 20.0 % impossible"));
    EXPECT_THAT(text, HasSubstr("20.0 % with frames that were silently missed"));
    EXPECT_THAT(text, testing::ContainsRegex("stated over true position error +4 +2 +2"));
    EXPECT_THAT(text, testing::ContainsRegex("time over the best fixed setting's +5 +2 +2"));
    EXPECT_THAT(text, testing::ContainsRegex("release +5 +1 +1"));
}

}  // namespace
}  // namespace drape::bench
