// --set /json/pointer=value changes a value of a scene.
#include <gtest/gtest.h>

#include "drape/scene_reader.h"
#include "full_scene.h"

namespace drape {
namespace {

using Texts = std::vector<std::string>;

SceneResult read_with(const Texts& overrides, std::string_view text = testing::full_scene) {
    return read_scene_text(text, "scene.json", overrides);
}

SceneDescription scene_with(const Texts& overrides, std::string_view text = testing::full_scene) {
    const SceneResult result = read_with(overrides, text);
    for (const SceneError& error : result.errors) ADD_FAILURE() << error.text();
    return result.scene.value_or(SceneDescription{});
}

Texts errors_with(const Texts& overrides, std::string_view text = testing::full_scene) {
    Texts texts;
    for (const SceneError& error : read_with(overrides, text).errors) texts.push_back(error.text());
    return texts;
}

TEST(SceneOverride, ReplacesValues) {
    EXPECT_EQ(scene_with({"/time/frames=3"}).time.frame_count, 3u);
    EXPECT_EQ(scene_with({"/gravity=[1, 2, 3]"}).gravity, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene_with({"/cloths/0/grid/1=65"}).cloths[0].grid[1], 65u);
    EXPECT_EQ(scene_with({"/name=\"a = b\""}).name, "a = b");
}

TEST(SceneOverride, ChangesNothingElse) {
    SceneDescription expected = scene_with({});
    expected.time.frame_count = 3;
    EXPECT_EQ(scene_with({"/time/frames=3"}), expected);
}

TEST(SceneOverride, LaterOnesWinAndReachIntoEarlierOnes) {
    EXPECT_EQ(scene_with({"/time/frames=3", "/time/frames=4"}).time.frame_count, 4u);
    EXPECT_EQ(scene_with({"/time={\"fps\": 5}", "/time/frames=4"}).time, (TimeSettings{5, 4}));
    EXPECT_EQ(scene_with({"/time/frames=4", "/time={\"fps\": 5}"}).time, (TimeSettings{5, TimeSettings{}.frame_count}));
}

TEST(SceneOverride, PlainWordsAreStrings) {
    EXPECT_TRUE(scene_with({"/forces=false", "/cloths/0/stiffness=rigid"}).cloths.at(0).stiffness.rigid);
    EXPECT_EQ(scene_with({"/cloths/0/name=flag-2"}).cloths[0].name, "flag-2");
    EXPECT_EQ(scene_with({"/name="}).name, "");
    EXPECT_EQ(scene_with({"/name=1,2"}).name, "1,2");
}

TEST(SceneOverride, MakesMissingMembers) {
    EXPECT_EQ(scene_with({"/cloths/0/damping=0.5"}, R"({"cloths": [{}]})").cloths[0].damping, 0.5);
    EXPECT_EQ(scene_with({"/solver/substeps=7"}, R"({"cloths": [{}]})").solver.substeps, 7u);
}

TEST(SceneOverride, AppendsToArrays) {
    const SceneDescription before = scene_with({});
    const std::size_t count = before.cloths[0].pins.size();
    for (const std::string& at : Texts{"-", std::to_string(count)}) {
        const SceneDescription scene = scene_with({"/cloths/0/pins/" + at + R"(={"at": [2, 1]})"});
        ASSERT_EQ(scene.cloths[0].pins.size(), count + 1);
        EXPECT_NE(scene.cloths[0].pins.back(), before.cloths[0].pins.back());
    }
    const SceneDescription made =
        scene_with({"/colliders/spheres/-/radius=2", "/colliders/spheres/-/radius=3"}, R"({"cloths": [{}]})");
    ASSERT_EQ(made.colliders.size(), 2u);
    EXPECT_NE(made.colliders[0], made.colliders[1]);
    EXPECT_EQ(errors_with({"/colliders/spheres/-=7"}, R"({"cloths": [{}]})"),
              Texts{"--set '/colliders/spheres/-=7': /colliders/spheres/0: expected an object, got 7"});
}

TEST(SceneOverride, ErrorsSayWhichOverride) {
    EXPECT_EQ(errors_with({"/cloths/0/grid/0=1"}),
              Texts{"--set '/cloths/0/grid/0=1': /cloths/0/grid/0: expected an integer from 2 to 16384, got 1"});
    EXPECT_EQ(errors_with({"/time=[1"}), Texts{"--set '/time=[1': /time: expected an object, got \"[1\""});
    EXPECT_EQ(errors_with({"/tiem/frames=3"}),
              Texts{"--set '/tiem/frames=3': /tiem: expected \"time\", got the unknown key \"tiem\""});
    EXPECT_EQ(errors_with({"/cloths/0/pins/5={}"}),
              Texts{"--set '/cloths/0/pins/5={}': /cloths/0/pins/5: expected an index into the 4 elements of "
                    "/cloths/0/pins, or - for a new one, got \"5\""});
    EXPECT_EQ(errors_with({"/cloths/01={}"}), Texts{"--set '/cloths/01={}': /cloths/01: expected an index "
                                                    "into the 4 elements of /cloths, or - for a new one, got \"01\""});
    EXPECT_EQ(errors_with({"/name/x=1"}),
              Texts{"--set '/name/x=1': /name/x: expected /name to be an object or an array"});
    EXPECT_EQ(errors_with({"time=1"}), Texts{"--set 'time=1': expected /json/pointer=value"});
    EXPECT_EQ(errors_with({""}), Texts{"--set '': expected /json/pointer=value"});
    EXPECT_EQ(errors_with({"/time"}), Texts{"--set '/time': expected /json/pointer=value"});
    EXPECT_EQ(errors_with({"/a~1b~0=1"}).at(0).substr(0, 34), "--set '/a~1b~0=1': /a~1b~0: expect");
}

TEST(SceneOverride, AllErrorsOfFileAndOverridesAtOnce) {
    EXPECT_EQ(errors_with({"/solver/substeps=0", "/wind/drag=-1"}, "{\"cloths\": [{}],\n \"wind\": {\"lift\": -2}}"),
              (Texts{"scene.json:2:19: /wind/lift: expected a number >= 0 (single precision), got -2",
                     "--set '/solver/substeps=0': /solver/substeps: expected an integer from 1 to 4096, got 0",
                     "--set '/wind/drag=-1': /wind/drag: expected a number >= 0 (single precision), got -1"}));
    EXPECT_EQ(errors_with({"time=1", "/cloths/9=1"}).size(), 2u);
}

TEST(SceneOverride, RepairsAFaultOfTheFile) {
    EXPECT_EQ(scene_with({"/time/fps=25"}, R"({"cloths": [{}], "time": {"fps": -1}})").time.fps, 25.0);
}

TEST(SceneOverride, OfManyErrorsTheFirstHundredAreTold) {
    const Texts errors = errors_with(Texts(150, "wrong"));
    ASSERT_EQ(errors.size(), 101u);
    EXPECT_EQ(errors[99], "--set 'wrong': expected /json/pointer=value");
    EXPECT_EQ(errors[100], "--set 'wrong': and 50 more");
    EXPECT_EQ(errors_with(Texts(100, "wrong")).size(), 100u);
}

}  // namespace
}  // namespace drape
