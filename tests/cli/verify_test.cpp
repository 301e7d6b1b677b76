// drape verify judges scenes by what their files promise.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <sstream>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A sheet's upper edge is carried and turned, and a scrap falls, for a second.
std::string scene_with(const std::string& oracles) {
    return R"({
  "time": {"fps": 60, "frames": 31}, "solver": {"method": "line", "substeps": 10},
  "cloths": [{"name": "sheet", "grid": [8, 6], "size": [1, 0.8], "placement": {"origin": [0, 2, 0]},
              "pins": [{"edge": "top", "path": [{"t": 0}, {"t": 0.4, "translate": [0.1, 0.05, 0], "rotate": [0, 25, 0]}]}]},
             {"name": "scrap", "grid": [4, 4], "size": [0.2, 0.2], "placement": {"origin": [3, 5, 0]}}],
  "oracles": [)" +
           oracles + "]\n}";
}

constexpr const char* promises =
    R"({"check": "pins_follow", "error": 1e-5},
    {"check": "falls", "cloth": 1, "from_row": 0, "until_frame": 30, "error": 1e-4})";

Outcome verify(const SceneFolder& folder, std::vector<std::string> more) {
    std::vector<std::string> arguments{"verify", folder.scene()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return drape(arguments, {.folder = folder.path()});
}

Json::Value json_of(const Outcome& outcome) {
    std::istringstream text(outcome.out);
    Json::Value value;
    text >> value;
    return value;
}

TEST(Verify, JudgesAnyScenesOraclesUnderValidation) {
    const SceneFolder folder(scene_with(promises));
    const Outcome outcome = verify(folder, {"--stretch", "0.5", "--penetration", "0"});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr(folder.scene() + ": ok (31 frames, "),
                                   HasSubstr("  met     plausible: 31 frames are finite and plausible\n"),
                                   HasSubstr("  met     oracle/pins_follow: off by "), HasSubstr("over paths of 0."),
                                   HasSubstr("  met     oracle/falls: scrap off by "),
                                   HasSubstr("  met     limit/stretch: RMS strain at most "),
                                   HasSubstr("  met     limit/penetration: penetration: nothing to measure\n"),
                                   HasSubstr("  met     validation: 0 validation messages\n")));
    EXPECT_EQ(verify(folder, {"-q"}).out, "");
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
}

TEST(Verify, AMissedPromiseIsExitCode7InEveryFormat) {
    const SceneFolder folder(scene_with(promises));
    const Outcome outcome = verify(folder, {"--set", "/oracles/1/error=1e-12", "--stretch", "0", "--json", "--junit",
                                            "report.xml", "--no-validate"});
    EXPECT_EQ(outcome.code, 7) << outcome.out << outcome.err;
    const Json::Value scene = json_of(outcome)[0];
    EXPECT_EQ(scene["file"].asString(), folder.scene());
    EXPECT_FALSE(scene["ok"].asBool());
    EXPECT_EQ(scene["frames"].asInt(), 31);
    std::map<std::string, bool> met;
    for (const Json::Value& check : scene["checks"]) met[check["check"].asString()] = check["met"].asBool();
    EXPECT_EQ(
        met,
        (std::map<std::string, bool>{
            {"plausible", true}, {"limit/stretch", false}, {"oracle/falls", false}, {"oracle/pins_follow", true}}));
    const std::string report = read_text(folder / "report.xml");
    EXPECT_THAT(report, AllOf(HasSubstr("<testsuites tests=\"4\" failures=\"2\" errors=\"0\" "),
                              HasSubstr("name=\"oracle/falls\"><failure message=\"scrap off by "),
                              HasSubstr("name=\"oracle/pins_follow\"><system-out>")));
    if (std::system("/usr/bin/python3 -c 'import xml' 2>/dev/null") == 0) {
        const std::string parse = "/usr/bin/python3 -c 'import sys, xml.etree.ElementTree as x; x.parse(sys.argv[1])' ";
        EXPECT_EQ(std::system((parse + (folder / "report.xml").string()).c_str()), 0);
    }
}

TEST(Verify, JudgesTheMotionWhereItsErrorIsEstimated) {
    const SceneFolder folder(scene_with(""));
    EXPECT_THAT(verify(folder, {}).out, testing::Not(HasSubstr("motion")));
    const std::vector<std::string> estimate{"--set", "/solver/estimate_error=true"};
    const Outcome met = verify(folder, estimate);
    EXPECT_EQ(met.code, 0) << met.out << met.err;
    EXPECT_THAT(met.out, AllOf(HasSubstr("  met     motion: positions at most about "),
                               HasSubstr(" from the exact motion (frame ")));
    std::vector<std::string> strict = estimate;
    strict.insert(strict.end(), {"--set", "/solver/tolerance_motion=1e-7"});
    const Outcome missed = verify(folder, strict);
    EXPECT_EQ(missed.code, 7);
    EXPECT_THAT(missed.out, HasSubstr("  MISSED  motion: positions at most about "));
    EXPECT_THAT(drape({"verify", "--help"}).out, AllOf(HasSubstr("motion"), HasSubstr("solver.tolerance_motion")));
}

TEST(Verify, NoOracleIsMetByFramesThatThereAreNot) {
    const std::string swing = R"({"check": "swing", "cloth": 1, "least": 0, "most": 1.001, )";
    for (const char* frames : {R"("from_frame": 20, "until_frame": 10})", R"("from_frame": 10, "until_frame": 10})",
                               R"("from_frame": 90, "until_frame": 99})"}) {
        const Outcome outcome = verify(SceneFolder(scene_with(swing + frames)), {"--no-validate"});
        EXPECT_EQ(outcome.code, 7) << frames;
        EXPECT_THAT(outcome.out, HasSubstr("  MISSED  oracle/swing: there are no such frames\n"));
    }
    const Outcome there =
        verify(SceneFolder(scene_with(swing + R"("from_frame": 0, "until_frame": 30})")), {"--no-validate"});
    EXPECT_THAT(there.out, HasSubstr("  met     oracle/swing: "));
}

TEST(Verify, WhatDivergesIsMissedAndItsOraclesWithIt) {
    const SceneFolder folder(scene_with(promises));
    const Outcome outcome =
        verify(folder, {"--no-validate", "--set", "/cloths/0/velocity=[0,-3e38,0]", "--set", "/time/fps=1"});
    EXPECT_EQ(outcome.code, 7);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("MISSED  plausible: "), HasSubstr("MISSED  oracle/falls: not judged: ")));
}

TEST(Verify, WrongScenesAreToldAndTheOthersJudged) {
    const SceneFolder folder(scene_with(promises));
    write_text(folder / "wrong.json", scene_with(R"({"check": "nonsense"})"));
    const Outcome outcome = drape({"verify", (folder / "wrong.json").string(), folder.scene(), "--junit",
                                   (folder / "r.xml").string(), "--no-validate"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("wrong.json: not run\n"), HasSubstr("wrong.json:6:25: /oracles/0/check: "),
                                   HasSubstr("scene.json: ok (31 frames")));
    EXPECT_THAT(read_text(folder / "r.xml"), HasSubstr("errors=\"1\""));
    EXPECT_EQ(drape({"verify", (folder / "no.json").string()}).code, 1);
    EXPECT_EQ(drape({"check", (folder / "wrong.json").string()}).code, 3);
}

TEST(Verify, AnOracleThatSaysNothingIsWarnedAbout) {
    const SceneFolder folder(scene_with(R"({"check": "penetration", "depth": 1e-5})"));
    const Outcome outcome = drape({"check", folder.scene()});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("/oracles/0: check penetration says nothing here: the scene has no collider\n"));
}

}  // namespace
}  // namespace drape
