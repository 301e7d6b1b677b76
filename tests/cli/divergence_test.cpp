// A simulation that is no longer finite ends with exit code 5 and keeps the frames before.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// The cloth flies 3e38 m in the first second, and out of single precision in the next one.
const std::vector<std::string> overflowing = {"--set", "/cloths/0/velocity=[0,-3e38,0]",
                                              "--set", "/time/fps=1",
                                              "--set", "/solver/substeps=1",
                                              "--set", "/cloths/0/pins=[]",
                                              "--set", "/colliders={}",
                                              "--set", "/cloths/0/stiffness/stretch=0",
                                              "--set", "/cloths/0/stiffness/shear=0"};

Outcome run_overflowing(const SceneFolder& folder, const std::vector<std::string>& more,
                        const std::string& command = "simulate") {
    std::vector<std::string> arguments{command, folder.scene(), "-o", folder.out(), "-q"};
    arguments.insert(arguments.end(), overflowing.begin(), overflowing.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return drape(arguments);
}

TEST(Divergence, StopsNamingFrameClothAndParticleAndKeepsTheFramesBefore) {
    const SceneFolder folder(small_scene(9));
    const Outcome outcome = run_overflowing(folder, {});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("the simulation diverged: in frame 2, cloth 'sheet'"),
                      HasSubstr("the particle in column 0, row 0 is not finite"),
                      HasSubstr("(48 of the cloth's 48 particles are not)"), HasSubstr("(2 of 9 frames)")));
    ASSERT_THAT(names_in(folder.out()),
                ElementsAre("failure.reproducer", "manifest.json", "positions.npy", "positions.npz"));
    EXPECT_THAT(read_text(folder / "out/manifest.json"),
                AllOf(HasSubstr("\"status\": \"diverged\""), HasSubstr("is not finite")));
    const std::string array = read_text(folder / "out/positions.npy");
    EXPECT_THAT(array, HasSubstr("'shape': (2, 6, 8, 3)"));
    EXPECT_EQ(array.size(), 128u + 2 * 6 * 8 * 3 * sizeof(float));
}

TEST(Divergence, StopsARenderToo) {
    const SceneFolder folder(small_scene(9));
    const Outcome outcome = run_overflowing(folder, {}, "render");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("the simulation diverged: in frame 2, cloth 'sheet'"), HasSubstr("(2 of 9 frames)")));
    EXPECT_THAT(names_in(folder.out()),
                ElementsAre("failure.reproducer", "frame_0000.png", "frame_0001.png", "manifest.json"));
}

TEST(Divergence, WithNoFrameBeforeLeavesTheReason) {
    const SceneFolder folder(small_scene(9));
    EXPECT_EQ(run_overflowing(folder, {"-s", "4"}).code, 5);
    EXPECT_THAT(names_in(folder.out()), ElementsAre("failure.reproducer", "manifest.json"));
    const Json::Value manifest = lasting_manifest(folder.out());
    EXPECT_EQ(manifest["status"], "diverged");
    EXPECT_EQ(manifest["failed"]["frame"], 2);
    EXPECT_EQ(manifest["failed"]["cloth"], "sheet");
    EXPECT_EQ(manifest["failed"]["particle"].size(), 2u);
    EXPECT_EQ(manifest["failed"]["criterion"], "particles that are not finite");
    EXPECT_EQ(manifest["failed"]["value"], 48);
}

/// One relaxed substep of these springs cannot carry this gravity.
const std::vector<std::string> absurd = {"--set", "/gravity=[0,-5000,0]", "--set", "/solver/substeps=1"};

std::vector<std::string> simulate_absurd(const SceneFolder& folder) {
    std::vector<std::string> arguments{"simulate", folder.scene(), "-o", folder.out(), "-q"};
    arguments.insert(arguments.end(), absurd.begin(), absurd.end());
    return arguments;
}

TEST(Divergence, WhatIsFiniteButNotPlausibleIsNoResult) {
    const SceneFolder folder(small_scene(9));
    const Outcome outcome = drape(simulate_absurd(folder));
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("not plausible: in frame 1, cloth 'sheet', the particle in column "),
                                   HasSubstr("begins a spring whose stretch error is "), HasSubstr("(1 of 9 frames)")));
    const Json::Value failed = lasting_manifest(folder.out())["failed"];
    EXPECT_EQ(failed["frame"], 1);
    EXPECT_EQ(failed["cloth"], "sheet");
    EXPECT_EQ(failed["criterion"], "stretch error of a spring");
    EXPECT_GT(failed["value"].asDouble(), failed["bound"].asDouble());
    EXPECT_THAT(outcome.err, HasSubstr(fmt::format("column {}, row {} ", failed["particle"][0].asUInt(),
                                                   failed["particle"][1].asUInt())));
    EXPECT_THAT(read_text(folder / "out/positions.npy"), HasSubstr("'shape': (1, 6, 8, 3)"));
}

TEST(Divergence, StiffnessThatRisesUnderLoadIsNoNonsense) {
    const SceneFolder folder(R"({"time": {"frames": 80}, "cloths": [{
        "grid": [9, 9], "size": [1, 1], "placement": {"origin": [0, 1, 0]}, "damping": 3,
        "stiffness": {"stretch": 300, "shear": 30}, "pins": [{"edge": "top"}],
        "stiffness_keys": [{"t": 1, "factor": 0.02}, {"t": 1.3, "factor": 0.5}]}]})");
    for (const std::string solver : {R"({})", R"({"method": "explicit", "substeps": 100})"}) {
        const Outcome outcome =
            drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--overwrite", "--set", "/solver=" + solver});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
}

TEST(Divergence, FailedFramesAreKeptWhereThatIsAskedForAndStillEndWithTheirCode) {
    const SceneFolder folder(small_scene(9));
    std::vector<std::string> arguments = simulate_absurd(folder);
    arguments.insert(arguments.end(), {"--on-failure", "keep"});
    const Outcome outcome = drape(arguments);
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("not plausible: in frame 1"), HasSubstr("--on-failure keep")));
    EXPECT_THAT(read_text(folder / "out/positions.npy"), HasSubstr("'shape': (9, 6, 8, 3)"));
    EXPECT_THAT(read_text(folder / "out/manifest.json"),
                AllOf(HasSubstr("\"status\": \"diverged\""), HasSubstr("\"failure\"")));
    const Outcome overflown = run_overflowing(SceneFolder(small_scene(9)), {"--on-failure", "keep"});
    EXPECT_EQ(overflown.code, 5);
    EXPECT_THAT(overflown.err, HasSubstr("(2 of 9 frames)"));
}

/// Returns what the manifest says of the whole run, whatever was written of it.
std::vector<Json::Value> verdict_of(const Outcome& outcome, const SceneFolder& folder, const std::string& out) {
    const Json::Value manifest = lasting_manifest(folder.out(out));
    return {outcome.code, manifest["status"], manifest["failed"], manifest["solver"]["stretch_error_rms"]};
}

TEST(Divergence, EveryFrameIsJudgedWhateverIsWritten) {
    std::mt19937 random(48);
    std::uniform_real_distribution<double> exponent(1, 4);
    std::set<int> codes;
    int scenes = 0;
    for (const std::string method : {"relax", "line", "relax", "auto", "line"}) {
        const SceneFolder folder(small_scene(9));
        const std::string on_failure = ++scenes % 2 == 0 ? "keep" : "stop";
        std::vector<std::string> scene{"simulate",
                                       folder.scene(),
                                       "-q",
                                       "--on-failure",
                                       on_failure,
                                       "--set",
                                       fmt::format("/gravity=[0,-{:.3g},0]", std::pow(10, exponent(random))),
                                       "--set",
                                       "/solver/method=" + method};
        if (method != "auto") scene.insert(scene.end(), {"--set", "/solver/substeps=1"});
        std::vector<std::vector<Json::Value>> verdicts;
        for (const std::vector<std::string>& written :
             std::vector<std::vector<std::string>>{{"-j", "1"}, {"-s", "8"}, {"-j", "4"}}) {
            std::vector<std::string> arguments = scene;
            arguments.insert(arguments.end(), written.begin(), written.end());
            const std::string out = fmt::format("out{}", verdicts.size());
            arguments.insert(arguments.end(), {"-o", folder.out(out)});
            const Outcome outcome = drape(arguments);
            verdicts.push_back(verdict_of(outcome, folder, out));
            codes.insert(outcome.code);
            EXPECT_EQ(verdicts.back(), verdicts.front()) << method << ", " << on_failure << ": " << outcome.err;
        }
    }
    EXPECT_THAT(codes, testing::IsSupersetOf({0, 5}));
}

}  // namespace
}  // namespace drape
