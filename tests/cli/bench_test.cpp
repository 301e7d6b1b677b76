// `drape bench accuracy` and `drape bench fabric` run as a user runs them: files, exit codes, and cases that a second
// run does not do again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "output/temporary_folder.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(BenchAccuracy, WritesEverythingAndGoesOnWhereItEnded) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments = {
        "bench",      "accuracy", "--short",         "--validate", "--filter",       "free fall", "--folder",
        folder / "b", "--json",   folder / "a.json", "--csv",      folder / "a.csv", "--svg",     folder / "plots"};
    const Outcome first = drape(arguments);
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_THAT(first.out, AllOf(HasSubstr("free fall/2/relax/16"), HasSubstr("met"), Not(HasSubstr("NOT MET")),
                                 Not(HasSubstr("swing"))));
    EXPECT_THAT(first.err,
                AllOf(HasSubstr("6/6 free fall/2/relax/16"), HasSubstr("ETA 0:00"), HasSubstr("6 cases run, 0 kept")));
    EXPECT_THAT(read_text(folder / "a.json"), HasSubstr("\"format\": \"drape bench accuracy 1\""));
    EXPECT_THAT(read_text(folder / "a.csv"), HasSubstr("\nfree fall/2/explicit/1,free fall,2,explicit,1,1,1,"));
    EXPECT_EQ(names_in(folder / "plots"), std::set<std::string>{"free_fall_substeps.svg"});

    // The last line, which a kill may have cut short, is taken away, so that one case is missing.
    std::string kept = read_text(folder / "b/results.jsonl");
    write_text(folder / "b/results.jsonl", kept.substr(0, kept.size() - 20));
    const Outcome second = drape(arguments);
    EXPECT_EQ(second.code, 0) << second.err;
    EXPECT_THAT(second.err, HasSubstr("1 cases run, 5 kept"));
    const Outcome third = drape(arguments);
    EXPECT_THAT(third.err, HasSubstr("0 cases run, 6 kept"));
    EXPECT_EQ(third.out.substr(third.out.find('\n')), second.out.substr(second.out.find('\n')));
}

TEST(BenchAccuracy, AReferenceIsComputedOnce) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments = {"bench",    "accuracy",           "--short",  "--validate",
                                                "--filter", "pendulum/1/relax/5", "--folder", folder.path()};
    const Outcome first = drape(arguments);
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_THAT(first.err, HasSubstr("reference motion of 4 particles"));
    std::filesystem::remove(folder / "results.jsonl");
    const Outcome second = drape(arguments);
    EXPECT_THAT(second.err, AllOf(HasSubstr("1 cases run"), Not(HasSubstr("reference motion"))));
}

TEST(BenchAccuracy, ABudgetLeavesOutWhatItCannotPay) {
    const TemporaryFolder folder;
    const Outcome outcome =
        drape({"bench", "accuracy", "--filter", "^swing/512/", "--budget", "0.001", "--folder", folder / "b"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("0 cases run, 0 kept from before, 36 left out"));
    EXPECT_THAT(outcome.out, HasSubstr("The budget of time left cases out."));
}

TEST(BenchAccuracy, ALimitThatIsNotMetIsExitCode7AndEverythingIsWrittenAllTheSame) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments = {
        "bench",    "accuracy",   "--short", "--filter",       "free fall/2/relax/1$",
        "--folder", folder / "b", "--json",  folder / "a.json"};
    EXPECT_EQ(drape(arguments).code, 0);
    const std::string kept = read_text(folder / "b/results.jsonl");
    const std::string worse = std::regex_replace(kept, std::regex("(\"position_relative\" ?: ?)[-+.e0-9]+"), "$010.5");
    ASSERT_NE(worse, kept);
    write_text(folder / "b/results.jsonl", worse);
    const Outcome outcome = drape(arguments);
    EXPECT_EQ(outcome.code, 7);
    EXPECT_THAT(outcome.out, HasSubstr("NOT MET"));
    EXPECT_THAT(outcome.err, HasSubstr("1 of the benchmark's limits, orders and promises not met"));
    EXPECT_THAT(read_text(folder / "a.json"), HasSubstr("0.5"));
}

TEST(BenchAccuracy, AUsersSceneIsMeasuredAgainstItsOwnRefinedRuns) {
    const SceneFolder folder(small_scene(7));
    const std::vector<std::string> arguments = {
        "bench",    "accuracy", folder.scene(), "--short",      "--validate", "--error",    "1e-1,1e-9",
        "--frames", "5",        "--filter",     "auto|line/8$", "--folder",   folder.out(), "--reference-substeps",
        "64"};
    const Outcome first = drape(arguments);
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_THAT(first.out,
                AllOf(HasSubstr("scene/7/line/8"), HasSubstr("scene/7/auto/chosen"), HasSubstr("Reference: "),
                      HasSubstr("Richardson"), HasSubstr("Cheapest measured setting"),
                      HasSubstr("cannot be told: the reference's own error is")));
    EXPECT_THAT(first.err, AllOf(HasSubstr("reference: line at "), HasSubstr("2 cases run, 0 kept")));
    EXPECT_THAT(names_in(folder.out()), testing::IsSupersetOf({"accuracy.csv", "accuracy.json", "results.jsonl"}));
    EXPECT_THAT(read_text(folder.out() + "/accuracy.csv"),
                AllOf(HasSubstr(",position_rms,"), HasSubstr(",worst_spring")));
    EXPECT_THAT(read_text(folder.out() + "/accuracy.json"), HasSubstr("\"compared_with\""));
    const Outcome second = drape(arguments);
    EXPECT_EQ(second.code, 0) << second.err;
    EXPECT_THAT(second.err, AllOf(HasSubstr("0 cases run, 2 kept"), Not(HasSubstr("reference: line at "))));
    EXPECT_EQ(second.out.substr(second.out.find('\n')), first.out.substr(first.out.find('\n')));
}

TEST(BenchAccuracy, FewestSubstepsAreLookedForAndNoneTwice) {
    const SceneFolder folder(small_scene(7));
    const std::vector<std::string> arguments = {
        "bench",    "accuracy",   folder.scene(),         "--error", "1e-2", "--filter", "(line|relax)/",
        "--folder", folder.out(), "--reference-substeps", "64"};
    const Outcome outcome = drape(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string csv = read_text(folder.out() + "/accuracy.csv");
    std::set<std::string> names;
    std::size_t row_count = 0;
    for (std::size_t at = csv.find('\n') + 1; at < csv.size(); at = csv.find('\n', at) + 1, ++row_count)
        names.insert(csv.substr(at, csv.find(',', at) - at));
    EXPECT_EQ(names.size(), row_count);
    EXPECT_TRUE(names.contains("scene/7/line/2")) << "the sweep begins with 4";
    EXPECT_FALSE(drape(arguments).code);
}

TEST(BenchAccuracy, RefusesAUsersSceneThatCannotBeMeasured) {
    const SceneFolder folder(small_scene(7)), still(small_scene(1)), wrong("{\"cloths\": 3}");
    const auto refused = [&](std::vector<std::string> options, int code, const char* message) {
        options.insert(options.begin(), {"bench", "accuracy", "--folder", folder.out()});
        const Outcome outcome = drape(options);
        EXPECT_EQ(outcome.code, code) << message;
        EXPECT_THAT(outcome.out, IsEmpty()) << message;
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_FALSE(std::filesystem::exists(folder.out())) << message;
    };
    refused({folder.scene(), "--frames", "0"}, 2, "--frames: expected a whole number from 1");
    refused({folder.scene(), "--error", "0"}, 2, "--error: expected metres above 0, separated by commas, got '0'");
    refused({folder.scene(), "--error", "1e-3,"}, 2, "--error");
    refused({folder.scene(), "--reference-substeps", "8"}, 2, "--reference-substeps: expected a whole number from 16");
    refused({folder.scene(), "--filter", "no such case"}, 2, "matches no case");
    refused({still.scene()}, 2, "has no frame after the first");
    refused({folder.scene() + "x"}, 1, "scene.jsonx");
    refused({wrong.scene()}, 3, "/cloths");
    refused({folder.scene(), "--device", "no such device"}, 4, "no such device");
}

TEST(BenchAccuracy, RefusesWhatItCannotDo) {
    const TemporaryFolder folder;
    const auto refused = [&](std::vector<std::string> options, int code, const char* message) {
        options.insert(options.begin(), {"bench", "accuracy", "--folder", folder / "b"});
        const Outcome outcome = drape(options);
        EXPECT_EQ(outcome.code, code) << message;
        EXPECT_THAT(outcome.out, IsEmpty()) << message;
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_FALSE(std::filesystem::exists(folder / "b/results.jsonl")) << message;
    };
    refused({"--filter", "("}, 2, "--filter '('");
    refused({"--filter", "no such case"}, 2, "matches no case");
    refused({"--budget", "soon"}, 2, "--budget: expected minutes above 0, got 'soon'");
    refused({"--budget", "-1"}, 2, "--budget");
    refused({"--filter", "free fall/2/relax/1$", "--device", "no such device"}, 4, "no such device");
    write_text(folder / "file", "");
    const Outcome outcome = drape({"bench", "accuracy", "--folder", folder / "file"});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_EQ(drape({"bench"}).code, 2);
    const Outcome help = drape({"bench", "accuracy", "--help"});
    EXPECT_THAT(help.out, AllOf(HasSubstr("Usage: drape bench accuracy"), HasSubstr("Exit codes: 0 ok, 1 file")));
}

TEST(BenchSpeed, MeasuresAndWritesEverything) {
    const SceneFolder folder(small_scene(2));
    const Outcome outcome =
        drape({"bench", "speed", "--short", "--validate", "--filter",
               "^(line/32$|explicit/(32|64)$|skip/statistics|start/simulate)", "--scenes", DRAPE_SOURCE_DIR "/scenes",
               "--json", folder.out("s.json"), "--csv", folder.out("s.csv"), "--svg", folder.out("plots")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("a copy moves"), HasSubstr("\nline/32 "), HasSubstr("\nskip/statistics "),
                                   HasSubstr("cold: pipelines and memory"), HasSubstr("warm: all")));
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("5/5 "), HasSubstr("5 cases run, 0 kept from before, 0 left out"),
                                   Not(HasSubstr("VUID"))));
    EXPECT_THAT(read_text(folder.out("s.json")), HasSubstr("\"format\": \"drape bench speed 1\""));
    EXPECT_THAT(read_text(folder.out("s.csv")), HasSubstr("\nexplicit/64,solve,4096,66,1,0,device,"));
    EXPECT_EQ(names_in(folder.out("plots")), std::set<std::string>{"speed_explicit.svg"});
}

TEST(BenchSpeed, RefusesWhatItCannotDo) {
    const auto refused = [&](std::vector<std::string> options, int code, const char* message) {
        options.insert(options.begin(), {"bench", "speed"});
        const Outcome outcome = drape(options);
        EXPECT_EQ(outcome.code, code) << message;
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_THAT(outcome.out, IsEmpty()) << message;
    };
    refused({"--filter", "("}, 2, "--filter '('");
    refused({"--filter", "no such case"}, 2, "matches no case");
    refused({"--budget", "0"}, 2, "--budget: expected minutes above 0");
    refused({"--filter", "line/32$", "--device", "no such device"}, 4, "no such device");
    const Outcome none = drape({"bench", "speed", "-q", "--filter", "skip/pictures", "--scenes", "no such folder"});
    EXPECT_EQ(none.code, 0) << none.err;
    EXPECT_THAT(none.out, HasSubstr("Cases were left out"));
}

TEST(BenchFabric, MeasuresWhatTheFabricIs) {
    const Outcome outcome = drape({"bench", "fabric", "--fabric", "denim", "--grid", "17", "--validate"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("denim       17    22.5"), Not(HasSubstr("silk"))));
    const std::string lengths = outcome.out.substr(outcome.out.rfind("denim"));
    std::smatch found;
    ASSERT_TRUE(std::regex_search(lengths, found, std::regex("denim +([0-9.]+) +([0-9.]+) +([0-9.]+) +([0-9.]+)")));
    // Peirce's formula is within 2 % of the elastica, and a strip of 32 links within 1 %.
    EXPECT_NEAR(std::stod(found[1]) / std::stod(found[2]), 1, 0.03) << lengths;
    EXPECT_NEAR(std::stod(found[3]) / std::stod(found[4]), 1, 0.03) << lengths;
    const Outcome unknown = drape({"bench", "fabric", "--fabric", "paper"});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("--fabric 'paper' is none of the fabrics"));
}

}  // namespace
}  // namespace drape
