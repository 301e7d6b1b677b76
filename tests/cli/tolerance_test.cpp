// A scene that misses its own tolerance ends with exit code 8 and keeps the frames before.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Tolerance, MissedEndsTheRunNamingFrameClothAndErrorAndKeepsTheFramesBefore) {
    const SceneFolder folder(small_scene(9));
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set",
                                   "/solver/tolerance=1e-5", "--set", "/solver/iterations=2"});
    EXPECT_EQ(outcome.code, 8) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("the tolerance is missed: in frame 1, cloth 'sheet', the stretch error is "),
                      HasSubstr("the scene allows 1e-05"), HasSubstr("(1 of 9 frames)")));
    EXPECT_THAT(names_in(folder.out()),
                ElementsAre("failure.reproducer", "manifest.json", "positions.npy", "positions.npz"));
    EXPECT_THAT(read_text(folder / "out/manifest.json"), AllOf(HasSubstr("\"status\": \"tolerance missed\""),
                                                               HasSubstr("\"failure\": \"the tolerance is missed")));
}

TEST(Tolerance, TheManifestOfARunThatStoppedSaysWhichFramesWereWritten) {
    const SceneFolder folder(small_scene(9));
    const auto frames_from = [&](const std::string& start) {
        const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out("from " + start), "-q", "-s", start,
                                       "--set", "/solver/tolerance=1e-5", "--set", "/solver/iterations=2"});
        EXPECT_EQ(outcome.code, 8) << outcome.err;
        return read_text(folder / ("from " + start) / "manifest.json");
    };
    EXPECT_THAT(frames_from("0"),
                AllOf(HasSubstr("\"count\": 1,"), HasSubstr("\"start\": 0,"), HasSubstr("\"end\": 0,")));
    EXPECT_THAT(frames_from("3"),
                AllOf(HasSubstr("\"count\": 0,"), HasSubstr("\"start\": 3,"), HasSubstr("\"end\": 2,")));
}

TEST(Tolerance, AClothThatStartsStrainedHasNoErrorBeforeTheFirstStep) {
    const SceneFolder folder(small_scene(3));
    for (const std::string method : {"line", "relax", "explicit"})
        for (const std::string tolerance : {"0.01", "0"}) {
            const Outcome outcome =
                drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--overwrite", "--set",
                       "/cloths/0/placement/scale=[1.05,1.05]", "--set",
                       fmt::format(R"(/solver={{"method":"{}","substeps":200,"tolerance":{}}})", method, tolerance)});
            EXPECT_EQ(outcome.code, 0) << outcome.err;
            EXPECT_THAT(outcome.err, Not(HasSubstr("the stretch error came to"))) << method;
            const Json::Value statistics = lasting_manifest(folder.out())["statistics"];
            EXPECT_NEAR(statistics[0]["sheet/stretch_max"].asDouble(), 0.05, 1e-3) << method;
            EXPECT_EQ(statistics[0]["sheet/stretch_error_rms"].asDouble(), 0) << method;
            EXPECT_EQ(statistics[0]["sheet/stretch_error_max"].asDouble(), 0) << method;
        }
}

TEST(Tolerance, MetIsARunLikeAnyOtherAndStatesItsIterations) {
    const SceneFolder folder(small_scene(4));
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set",
                                   "/solver/tolerance=0.5", "--set", "/solver/iterations=6"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string manifest = read_text(folder / "out/manifest.json");
    EXPECT_THAT(manifest, HasSubstr("sheet/iterations"));
}

}  // namespace
}  // namespace drape
