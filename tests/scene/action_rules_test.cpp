// What a scene cannot be told is an error, with its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/scene_reader.h"

namespace drape {
namespace {

constexpr const char* cloths =
    R"({"time": {"frames": 5}, "cloths": [{"name": "a", "grid": [5, 4], "pins": [{"corner": "top_left"}]}],
"actions": )";

std::vector<std::string> errors_of(const std::string& actions) {
    std::vector<std::string> texts;
    for (const SceneError& error : read_scene_text(cloths + actions + "}", "s").errors)
        texts.push_back(std::to_string(error.line) + ": " + error.pointer + ": " + error.message);
    return texts;
}

TEST(ActionRules, TakeWhatAnEnsembleTakes) {
    const SceneResult read = read_scene_text(std::string(cloths) +
                                                 R"({"controls": ["wind", "pins", "holds"], "hands": ["a"], "steps": [
        {"frame": 1, "wind": [1, 2, 3], "hands": [[1, 2, 3]], "grasps": [[4, 3]]},
        {"frame": 4, "pins": [[0, 1, 2, 3, 4, 5]], "holds": [false], "grasps": [[-1, -1]]}]}})",
                                             "s");
    ASSERT_TRUE(read.scene.has_value()) << read.errors.front().text();
    FrameActions first{.frame = 1}, second{.frame = 4};
    first.wind = Vec3{1, 2, 3};
    first.hands = {{1, 2, 3, 0, 0, 0}};
    first.grasps = {{4, 3, 4, 3}};
    second.pins = {{0, 1, 2, 3, 4, 5}};
    second.holds = {false};
    second.grasps = {{-1, -1, -1, -1}};
    EXPECT_EQ(*read.scene->actions,
              (SceneActions{{.wind = true, .pins = true, .holds = true, .hands = {0}}, {first, second}}));
}

TEST(ActionRules, TellWhatCannotBeTold) {
    EXPECT_EQ(errors_of(R"({"controls": ["winds", 3], "hands": ["b"], "steps": [{"frame": 2},
 {"frame": 2}, {"wind": [1, 2, 3]}]})"),
              (std::vector<std::string>{
                  "2: /actions/controls/0: expected one of \"wind\", \"pins\", \"colliders\", \"holds\", \"gravity\", "
                  "\"loads\", \"bodies\", got \"winds\"",
                  "2: /actions/controls/1: expected one of \"wind\", \"pins\", \"colliders\", \"holds\", \"gravity\", "
                  "\"loads\", \"bodies\", got 3",
                  "3: /actions/steps/2/frame: expected a frame from 1 on, got nothing"}));
    EXPECT_EQ(errors_of(R"({"hands": ["b"]})"),
              (std::vector<std::string>{"2: /actions/hands/0: expected the name of a cloth, got \"b\""}));
    EXPECT_EQ(errors_of(R"({"steps": [{"frame": 2},
 {"frame": 2}]})"),
              (std::vector<std::string>{
                  "3: /actions/steps/1/frame: expected a frame after that of the entry before, 2, got 2"}));
    EXPECT_EQ(errors_of(R"({"controls": ["pins"], "hands": ["a"], "steps": [
 {"frame": 5, "pins": [[0, 0, 0], [0, 0, 0]], "wind": [1, 0, 0]}]})"),
              (std::vector<std::string>{
                  "3: /actions/steps/0/frame: expected a frame of the scene, whose last one is 4, got 5",
                  "3: /actions/steps/0/pins: expected 1 entries, got 2",
                  "3: /actions/steps/0/wind: expected \"wind\" among the controls of actions, got it not"}));
    EXPECT_EQ(errors_of(R"({"hands": ["a"], "steps": [
 {"frame": 1, "hands": [[0, 0]], "grasps": [[5, 0]]}]})"),
              (std::vector<std::string>{"3: /actions/steps/0/hands/0: expected an array of 3 or 6 numbers, got "
                                        "[0, 0]"}));
    EXPECT_EQ(errors_of(R"({"hands": ["a"], "steps": [
 {"frame": 1, "grasps": [[5, 0]]}]})"),
              (std::vector<std::string>{"3: /actions/steps/0/grasps/0: expected particles of cloth \"a\", which has 5 "
                                        "columns and 4 rows, got columns 5 to 5 of rows 0 to 0"}));
    EXPECT_EQ(
        errors_of(R"({"controls": ["loads"]})"),
        (std::vector<std::string>{"2: /actions/controls: expected loads of a cloth, of 0 N where only actions are "
                                  "to pull, got none"}));
}

TEST(ActionRules, ForcesAreTrueFalseWorstOrFields) {
    const auto read = [](const std::string& forces) {
        return read_scene_text(R"({"cloths": [{}], "forces": )" + forces + "}", "s");
    };
    EXPECT_TRUE(read("\"worst\"").scene->worst_forces && read("\"worst\"").scene->forces);
    EXPECT_TRUE(read("true").scene->forces && !read("true").scene->worst_forces);
    EXPECT_FALSE(read("false").scene->forces);
    EXPECT_FALSE(read("\"worst\"").scene->force_fields);
    EXPECT_TRUE(read("\"fields\"").scene->force_fields && read("\"fields\"").scene->worst_forces);
    EXPECT_EQ(read("\"mean\"").errors.at(0).message, "expected true, false, \"worst\" or \"fields\", got \"mean\"");
}

}  // namespace
}  // namespace drape
