// One run of a sweep alone gives the bytes of the whole sweep; failures are counted; the data set opens in Python.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <sstream>
#include <thread>

#include "output/json_file.h"
#include "output/json_text.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Six runs of the small scene, the third of which has no mass.
constexpr const char* six_runs = R"({
  "scene": "scene.json", "seed": 5, "set": {"/time/frames": 5},
  "vary": {"/cloths/0/areal_density": {"grid": [0.1, 0.2, -1]}, "/cloths/0/damping": {"grid": [0, 1]},
           "/gravity/0": {"uniform": [-1, 1]}}
})";

class Sweep : public testing::Test {
  protected:
    Sweep() : folder(small_scene(9)) { write_text(folder / "spec.json", six_runs); }

    Outcome sweep(std::vector<std::string> more, const std::string& output = "out") const {
        std::vector<std::string> arguments{"sweep", "spec.json", "-o", output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return drape(arguments, {.folder = folder.path()});
    }
    std::string file(const std::string& name) const { return read_text(folder / name); }
    /// Returns the lines of the table, in order, without the times at their ends.
    std::vector<std::string> results(const std::string& output = "out") const {
        std::istringstream text(file(output + "/results.csv"));
        std::vector<std::string> lines;
        for (std::string line; std::getline(text, line);) lines.push_back(line.substr(0, line.rfind(',')));
        return lines;
    }

    SceneFolder folder;
};

TEST_F(Sweep, RunsAllCountsFailuresAndOneAloneHasEqualBytes) {
    const Outcome all = sweep({"--jobs", "2", "-q"});
    EXPECT_EQ(all.code, 9) << all.err;
    EXPECT_THAT(all.err, AllOf(HasSubstr("4 done, 2 failed, 0 missing"), HasSubstr("run 4: scene: "),
                               HasSubstr("areal_density: expected a number > 0"), HasSubstr("run 5: scene: ")));
    const std::vector<std::string> lines = results();
    ASSERT_EQ(lines.size(), 7u);
    EXPECT_THAT(lines[0],
                HasSubstr("index,status,exit_code,message,/cloths/0/areal_density,/cloths/0/damping,/gravity/0,"));
    EXPECT_THAT(lines[1], HasSubstr("0,done,0,,0.1,0,"));
    EXPECT_THAT(lines[4], HasSubstr("3,done,0,,0.2,1,"));
    EXPECT_THAT(lines[6], HasSubstr("5,scene,3,"));
    EXPECT_THAT(names_in(folder / "out/runs"), testing::UnorderedElementsAre("0000", "0001", "0002", "0003"));

    for (int index = 5; index >= 0; --index)
        EXPECT_EQ(sweep({"--index", std::to_string(index)}, "alone").code, index < 4 ? 0 : 3);
    EXPECT_EQ(sweep({"--collect", "-q"}, "alone").code, 9);
    EXPECT_EQ(results("alone"), lines);
    for (const char* run : {"0000", "0001", "0002", "0003"}) {
        const std::string name = std::string("/runs/") + run;
        EXPECT_EQ(file("alone" + name + "/positions.npz"), file("out" + name + "/positions.npz")) << run;
        EXPECT_EQ(lasting_manifest(folder / ("alone" + name)), lasting_manifest(folder / ("out" + name))) << run;
    }
    EXPECT_NE(file("out/runs/0000/positions.npz"), file("out/runs/0001/positions.npz"));
}

/// Runs of one process are members of an ensemble; some end early and some diverge.
TEST_F(Sweep, RunsThatGoOnTogetherHaveTheBytesOfEachAlone) {
    write_text(folder / "spec.json",
               R"({"scene": "scene.json", "seed": 7, "count": 8, "set": {"/cloths/0/velocity": [0, 0, 0]},
        "vary": {"/time/frames": {"grid": [5, 9]}, "/cloths/0/velocity/1": {"grid": [0, 1e37]},
                 "/cloths/0/areal_density": {"uniform": [0.1, 0.4]}, "/cloths/0/stiffness/stretch": {"uniform": [300, 900]}}})");
    const Outcome together = sweep({"--index", "0-7"}, "together");
    EXPECT_EQ(together.code, 9) << together.err;
    EXPECT_THAT(together.err, HasSubstr("run 2: the simulation diverged"));
    for (int index = 0; index < 8; ++index)
        EXPECT_EQ(sweep({"--index", std::to_string(index)}, "alone").code, index % 4 < 2 ? 0 : 5);
    for (const char* output : {"together", "alone"}) EXPECT_EQ(sweep({"--collect", "-q"}, output).code, 9);
    EXPECT_EQ(results("together"), results("alone"));
    EXPECT_THAT(results("together")[1], HasSubstr("0,done,0,,"));
    EXPECT_THAT(results("together")[3], HasSubstr("2,diverged,5,"));
    for (const char* run : {"0000", "0001", "0004", "0005"}) {
        const std::string name = std::string("/runs/") + run;
        EXPECT_EQ(file("together" + name + "/positions.npz"), file("alone" + name + "/positions.npz")) << run;
        EXPECT_EQ(lasting_manifest(folder / ("together" + name)), lasting_manifest(folder / ("alone" + name))) << run;
    }
}

/// Each keeps the substeps that it needs, and where that does not help it is refused as alone.
TEST_F(Sweep, RunsByMethodAutoThatGoOnTogetherHaveTheBytesOfEachAlone) {
    write_text(folder / "spec.json",
               R"({"scene": "scene.json", "seed": 7, "count": 12, "set": {"/solver": {"method": "auto"}},
        "vary": {"/time/frames": {"grid": [5, 9]}, "/gravity/1": {"grid": [-9.81, -1e3, -1e7]},
                 "/cloths/0/areal_density": {"uniform": [0.1, 0.4]},
                 "/cloths/0/stiffness/stretch": {"uniform": [300, 900]}}})");
    const Outcome together = sweep({"--index", "0-11"}, "together");
    EXPECT_EQ(together.code, 9) << together.err;
    EXPECT_THAT(together.err, HasSubstr("run 4: the tolerance is missed"));
    for (int index = 0; index < 12; ++index)
        EXPECT_EQ(sweep({"--index", std::to_string(index)}, "alone").code, index % 6 < 4 ? 0 : 8) << index;
    for (const char* output : {"together", "alone"}) EXPECT_EQ(sweep({"--collect", "-q"}, output).code, 9);
    EXPECT_EQ(results("together"), results("alone"));
    EXPECT_THAT(results("together")[5], HasSubstr("4,tolerance,8,"));
    std::set<std::string> substeps;
    for (int index = 0; index < 12; ++index) {
        const std::string name = fmt::format("/runs/{:04}", index);
        EXPECT_EQ(file("together" + name + "/positions.npz"), file("alone" + name + "/positions.npz")) << index;
        const Json::Value manifest = lasting_manifest(folder / ("together" + name));
        EXPECT_EQ(manifest, lasting_manifest(folder / ("alone" + name))) << index;
        if (index % 6 < 4) substeps.insert(manifest["statistics"][4]["substeps"].asString());
    }
    EXPECT_GT(substeps.size(), 1u);
}

TEST_F(Sweep, RunsByMethodAutoOfWhichSomeHaveMovingCollidersHaveTheBytesOfEachAlone) {
    write_text(folder / "spec.json",
               R"({"scene": "scene.json", "seed": 7, "count": 3,
        "set": {"/time/frames": 12, "/solver": {"method": "auto"},
                "/cloths/0/placement": {"origin": [-0.5, 0.02, 0], "v": [0, 0, 1]}, "/cloths/0/pins": []},
        "vary": {"/colliders/planes": {"grid": [[{}], [{"path": [{"t": 0}, {"t": 0.2, "translate": [0, 0.1, 0]}]}],
                                                [{"friction": 0}]]}}})");
    EXPECT_EQ(sweep({"--index", "0-2"}, "together").code, 0);
    for (int index = 0; index < 3; ++index) {
        EXPECT_EQ(sweep({"--index", std::to_string(index)}, "alone").code, 0) << index;
        const std::string name = fmt::format("/runs/{:04}", index);
        EXPECT_EQ(file("together" + name + "/positions.npz"), file("alone" + name + "/positions.npz")) << index;
        EXPECT_EQ(lasting_manifest(folder / ("together" + name)), lasting_manifest(folder / ("alone" + name)));
    }
}

/// Each has the proof about its own cloth.
TEST_F(Sweep, RunsInWhichClothMeetsItselfThatGoOnTogetherHaveTheBytesOfEachAlone) {
    write_text(folder / "spec.json",
               R"({"scene": "scene.json", "seed": 7, "count": 6,
        "set": {"/time/frames": 20, "/solver": {"method": "line", "substeps": 8, "estimate_error": false}, "/cloths/0/pins": [],
                "/cloths/0/self_collision": {"thickness": 0.03},
                "/cloths/0/placement": {"origin": [-0.5, 1.02, 0], "u": [1, 0, 0], "v": [0, -1, 0]}},
        "vary": {"/cloths/0/areal_density": {"uniform": [0.1, 0.4]}, "/cloths/0/stiffness/stretch": {"uniform": [30, 90]},
                 "/cloths/0/velocity": {"grid": [[0, -4, 1], [0, -2, 0.5], [0, 0, 0]]}}})");
    EXPECT_EQ(sweep({"--index", "0-5"}, "together").code, 0);
    std::set<std::string> pairs;
    for (int index = 0; index < 6; ++index) {
        EXPECT_EQ(sweep({"--index", std::to_string(index)}, "alone").code, 0) << index;
        const std::string name = fmt::format("/runs/{:04}", index);
        EXPECT_EQ(file("together" + name + "/positions.npz"), file("alone" + name + "/positions.npz")) << index;
        const Json::Value manifest = lasting_manifest(folder / ("together" + name));
        EXPECT_EQ(manifest, lasting_manifest(folder / ("alone" + name))) << index;
        pairs.insert(manifest["self_collision"]["most_pairs"].asString());
    }
    EXPECT_GT(pairs.size(), 2u);
}

/// It is not known which of several runs ended their process: all of them are made again, alone.
TEST_F(Sweep, AProcessThatIsKilledCostsNoRun) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "seed": 7, "count": 3, "set": {"/time/frames": 1500},
        "vary": {"/cloths/0/areal_density": {"uniform": [0.1, 0.4]}}})");
    Running all(DRAPE_PROGRAM, {"sweep", "spec.json", "-o", "out", "--jobs", "1"}, {.folder = folder.path()});
    const auto begun = [&] {
        for (const char* run : {"0000", "0001", "0002"})
            if (!std::filesystem::exists(folder / (std::string("out/runs/") + run))) return false;
        return true;
    };
    ASSERT_TRUE(all.wait_until(begun));
    const std::string child = read_text(fmt::format("/proc/{0}/task/{0}/children", all.id()));
    ASSERT_GT(std::atoi(child.c_str()), 0);
    ASSERT_EQ(kill(std::atoi(child.c_str()), SIGKILL), 0);
    const Outcome ended = all.wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("3 done, 0 failed, 0 missing"));
    EXPECT_EQ(sweep({"--index", "1"}, "alone").code, 0);
    EXPECT_EQ(file("out/runs/0001/positions.npz"), file("alone/runs/0001/positions.npz"));
}

TEST_F(Sweep, ThatIsKilledTakesItsProcessesAlong) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "seed": 7, "count": 2, "set": {"/time/frames": 20000},
        "vary": {"/cloths/0/areal_density": {"uniform": [0.1, 0.4]}}})");
    Running all(DRAPE_PROGRAM, {"sweep", "spec.json", "-o", "out", "--jobs", "1"}, {.folder = folder.path()});
    ASSERT_TRUE(all.wait_until([&] { return std::filesystem::exists(folder / "out/runs/0001"); }));
    const std::string child = read_text(fmt::format("/proc/{0}/task/{0}/children", all.id()));
    const int process = std::atoi(child.c_str());
    ASSERT_GT(process, 0);
    ASSERT_EQ(kill(all.id(), SIGKILL), 0);
    all.wait();
    const auto is_there = [&] { return kill(process, 0) == 0; };
    for (int wait = 0; wait < 100 && is_there(); ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(is_there()) << "it would be writing what --resume wants to write";
    EXPECT_TRUE(std::filesystem::exists(folder / "out/jobs/0000-0001.log"));
    write_text(folder / "out/jobs/0000.json", R"({"exit_code": 0, "message": "", "seconds": 1, "values": {}})");
    write_text(folder / "out/jobs/0001.json", R"({"exit_code": 0, "message": "", "seconds": 1, "values": {}})");
    EXPECT_EQ(sweep({"--resume", "-q"}).code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/jobs/0000-0001.log"));
}

TEST_F(Sweep, RunsOfAnIndexAreRunsAndEachCountsOnce) {
    for (const char* index : {"", "3-1", "6", "1,", "x"}) {
        const Outcome outcome = sweep({"--index", index});
        EXPECT_EQ(outcome.code, 2) << index;
        EXPECT_THAT(outcome.err, HasSubstr(fmt::format("expected runs from 0 to 5, as in 7, 0-99 or 1,5,9-12, got "
                                                       "'{}'",
                                                       index)));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_EQ(sweep({"--index", "1,0-1,1", "-q"}).code, 0);
    EXPECT_EQ(sweep({"--index", "3-5"}).code, 9) << "runs have failed";
    EXPECT_EQ(sweep({"--index", "5"}).code, 3) << "a run's own code";
}

TEST_F(Sweep, ABadFirstRunIsAFailedRun) {
    write_text(
        folder / "spec.json",
        R"({"scene": "scene.json", "set": {"/time/frames": 3}, "vary": {"/cloths/0/damping": {"grid": [-1, 1]}}})");
    EXPECT_EQ(sweep({"--index", "1"}, "alone").code, 0);
    EXPECT_EQ(sweep({"-q"}).code, 9);
    EXPECT_THAT(results()[1], testing::StartsWith("0,scene,3,"));
    EXPECT_THAT(results()[2], testing::StartsWith("1,done,0,"));
    write_text(folder / "spec.json", R"({"scene": "scene.json", "vary": {"/cloths/0/damping": {"grid": [-1, -2]}}})");
    EXPECT_EQ(sweep({"-q"}, "none").code, 3) << "no run is good";
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

TEST_F(Sweep, RunsOfSeveralShapesHaveFilesOfTheirMessages) {
    write_text(folder / "spec.json",
               R"({"scene": "scene.json", "set": {"/time/frames": 3, "/cloths/0/velocity": [1e30, 0, 0]},
        "vary": {"/cloths/0/damping": {"grid": [0, 1]}, "/cloths/0/grid": {"grid": [[8, 6], [7, 6]]}}})");
    EXPECT_EQ(sweep({"--jobs", "1", "-q"}).code, 9);
    for (const char* log : {"0000.log", "0001.log", "0002.log", "0003.log"})
        EXPECT_THAT(file(std::string("out/jobs/") + log), HasSubstr("diverged")) << log;
}

TEST_F(Sweep, RunsThatAreDoneAreNoDataSet) {
    write_text(
        folder / "spec.json",
        R"({"scene": "scene.json", "set": {"/time/frames": 3}, "vary": {"/cloths/0/damping": {"grid": [0, 1]}}})");
    EXPECT_EQ(sweep({"-q"}).code, 0);
    for (const char* also : {"--resume", "--collect"}) {
        const Outcome outcome = sweep({"--dataset", also});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_THAT(outcome.err, HasSubstr("run 0 of 'out' was made without it and has no trajectory"));
    }
}

TEST_F(Sweep, RecordsHaveValuesOfTheirTypesAndTheTablePlainWords) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "set": {"/time/frames": 2},
        "vary": {"/cloths/0/damping": {"grid": [0.5]}, "/cloths/0/fabric": {"grid": ["silk"]}}})");
    EXPECT_EQ(sweep({"-q"}).code, 0);
    Json::Value record;
    std::istringstream(file("out/jobs/0000.json")) >> record;
    EXPECT_EQ(record["parameters"]["/cloths/0/damping"], Json::Value(0.5));
    EXPECT_EQ(record["parameters"]["/cloths/0/fabric"], Json::Value("silk"));
    EXPECT_THAT(results()[1], HasSubstr("0,done,0,,0.5,silk,"));
}

TEST_F(Sweep, GoesOnWhereItWasAndSaysWhatIsMissing) {
    EXPECT_EQ(sweep({"--index", "1,2-3"}).code, 0);
    const Outcome collected = sweep({"--collect"});
    EXPECT_EQ(collected.code, 9);
    EXPECT_THAT(collected.err, HasSubstr("3 done, 0 failed, 3 missing"));
    EXPECT_EQ(sweep({}).code, 1) << "without --resume";
    const std::string kept = file("out/jobs/0001.json");
    EXPECT_EQ(sweep({"--resume", "-q"}).code, 9);
    EXPECT_EQ(file("out/jobs/0001.json"), kept);
    EXPECT_EQ(results().size(), 7u);

    write_text(folder / "spec.json",
               std::string(six_runs).replace(std::string(six_runs).find("\"seed\": 5"), 9, "\"seed\": 6"));
    const Outcome other = sweep({"--resume"});
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.err, HasSubstr("is another sweep's"));
}

/// The file size limit acts as a full disk does: it says nothing of the run.
TEST_F(Sweep, AFileThatCannotBeWrittenEndsItAndItGoesOnWhenItCan) {
    if (driver_keeps_memory_in_files()) GTEST_SKIP() << "the limit ends the driver first";
    write_text(folder / "spec.json", R"({"scene": "scene.json", "vary": {"/cloths/0/damping": {"grid": [0, 1]}}})");
    const Outcome stopped = drape({"sweep", "spec.json", "-o", "out", "--jobs", "1", "-q"},
                                  {.folder = folder.path(), .file_size_limit = 4096});
    EXPECT_EQ(stopped.code, 1) << stopped.err;
    EXPECT_THAT(stopped.err, AllOf(HasSubstr("drape: run 0: cannot write 'out/runs/0000/"),
                                   HasSubstr("positions.npz': File too large")));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/jobs/0000.json"));
    EXPECT_EQ(sweep({"--resume", "-q"}).code, 0);
    EXPECT_EQ(sweep({"-q"}, "whole").code, 0);
    EXPECT_EQ(results(), results("whole"));
    EXPECT_EQ(file("out/runs/0000/positions.npz"), file("whole/runs/0000/positions.npz"));
    EXPECT_EQ(names_in(folder / "out/jobs"), names_in(folder / "whole/jobs"));
}

TEST_F(Sweep, TellsItsRunsAndRefusesOthers) {
    EXPECT_EQ(drape({"sweep", "spec.json", "--count"}, {.folder = folder.path()}).out, "6\n");
    const std::string list = drape({"sweep", "spec.json", "--list"}, {.folder = folder.path()}).out;
    EXPECT_EQ(std::ranges::count(list, '\n'), 6);
    EXPECT_THAT(list, HasSubstr("3\t/cloths/0/areal_density=0.2\t/cloths/0/damping=1\t/gravity/0="));
    for (const char* index : {"6", "1-", "a", "1,,2", "2-9"}) EXPECT_EQ(sweep({"--index", index}).code, 2) << index;
    EXPECT_EQ(drape({"sweep", "spec.json"}, {.folder = folder.path()}).code, 2) << "no folder";
    EXPECT_EQ(drape({"sweep", "absent.json", "-o", "x"}, {.folder = folder.path()}).code, 1);
    std::filesystem::create_directory(folder / "full");
    write_text(folder / "full/file", "mine");
    EXPECT_EQ(sweep({}, "full").code, 1);
}

// Processes of its own are told, too.
TEST_F(Sweep, ItsArchivesMayBePacked) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "seed": 2, "count": 2,
        "vary": {"/gravity/0": {"uniform": [-1, 1]}}})");
    ASSERT_EQ(sweep({"-q"}).code, 0);
    ASSERT_EQ(sweep({"-q", "--compress", "--jobs", "2"}, "packed").code, 0);
    const std::string name = "/runs/0001/positions.npz";
    EXPECT_LT(file("packed" + name).size(), file("out" + name).size() / 2);
}

TEST_F(Sweep, ItsDataSetOpensInPython) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "seed": 2, "count": 3,
        "vary": {"/gravity/0": {"uniform": [-1, 1]}}})");
    const Outcome made = sweep({"--dataset", "-q"});
    EXPECT_EQ(made.code, 0) << made.err;
    const Outcome loaded = Running("/usr/bin/python3", {DRAPE_SOURCE_DIR "/tools/examples/sweep/load_dataset.py",
                                                        (folder / "out/dataset").string()})
                               .wait();
    EXPECT_EQ(loaded.code, 0) << loaded.err;
    EXPECT_THAT(loaded.out, AllOf(HasSubstr("3 trajectories of 9 frames"), HasSubstr("'world_pos': [9, 129, 3]"),
                                  HasSubstr("'cells': [1, 198, 3]")));
    write_text(folder / "scene.json",
               R"({"cloths": [{}], "gravity": [0, 0, 0], "cutters": [{"triangle": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        "active": [0, 1]}]})");
    const Outcome cut = sweep({"--dataset", "--resume"}, "other");
    EXPECT_EQ(cut.code, 2);
    EXPECT_THAT(cut.err, HasSubstr("the scene has cutters"));
    write_text(folder / "scene.json", R"({"cloths": [{"tear": {"strain": 0.5}}], "gravity": [0, 0, 0]})");
    const Outcome torn = sweep({"--dataset", "--resume"}, "torn");
    EXPECT_EQ(torn.code, 2);
    EXPECT_THAT(torn.err, HasSubstr("the scene has cloth that tears"));
}

TEST_F(Sweep, ItsDataSetHasObstaclesOfOneShapeThatMove) {
    write_text(folder / "scene.json", R"({"time": {"frames": 5}, "solver": {"method": "relax", "substeps": 2},
        "cloths": [{"grid": [4, 4], "placement": {"origin": [0, 3, 0]}}],
        "colliders": {"spheres": [{"path": [{"t": 0}, {"t": 1, "translate": [1, 0, 0]}]}]}})");
    write_text(folder / "spec.json", R"({"scene": "scene.json", "seed": 2, "count": 2,
        "vary": {"/colliders/spheres/0/radius": {"uniform": [0.1, 0.4]}}})");
    const Outcome made = sweep({"--dataset", "-q"});
    EXPECT_EQ(made.code, 0) << made.err;
    const auto load = [&](const std::string& name) {
        return Running("/usr/bin/python3",
                       {DRAPE_SOURCE_DIR "/tools/examples/sweep/load_dataset.py", (folder / name / "dataset").string()})
            .wait();
    };
    const Outcome loaded = load("out");
    EXPECT_EQ(loaded.code, 0) << loaded.err;
    EXPECT_THAT(loaded.out, AllOf(HasSubstr("'world_pos': [5, 282, 3]"), HasSubstr("'cells': [1, 546, 3]")));
    write_text(folder / "spec.json", R"({"scene": "scene.json", "vary": {"/colliders/spheres":
        {"grid": [[{"radius": 0.2}], [{"radius": 0.2}, {"radius": 0.3, "center": [2, 0, 0]}]]}}})");
    ASSERT_EQ(sweep({"--dataset", "-q"}, "other").code, 0);
    const Outcome two = load("other");
    EXPECT_EQ(two.code, 0) << two.err;
    EXPECT_THAT(two.out, HasSubstr("'world_pos': [5, -1, 3]"));
}

TEST_F(Sweep, TextInItsTableIsNoFormulaAndHoldsNoControlCharacter) {
    write_text(folder / "spec.json", R"json({"scene": "scene.json", "set": {"/time/frames": 1},
        "vary": {"/cloths/0/damping": {"grid": [0.5]},
                 "/name": {"grid": ["=HYPERLINK(1)", "+1", "-2", "@x", "a\u001b[31m\nb", "a,\"b\""]}}})json");
    EXPECT_EQ(sweep({"-q"}).code, 0);
    const std::vector<std::string> lines = results();
    ASSERT_EQ(lines.size(), 7u);
    const std::vector<std::string> names{"'=HYPERLINK(1)", "'+1", "'-2", "'@x", "a\\x1b[31m\\x0ab", R"("a,""b""")"};
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_THAT(lines[i + 1], HasSubstr(",0.5," + names[i] + ","));
}

TEST_F(Sweep, RecordsOfWrongTypesAreRefusedByNameAndPlace) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "set": {"/time/frames": 1},
        "vary": {"/cloths/0/damping": {"grid": [0.5]}}})");
    ASSERT_EQ(sweep({"-q"}).code, 0);
    const Json::Value good = read_json(folder / "out/jobs/0000.json", {});
    for (const auto& [name, value] : std::multimap<std::string, Json::Value>{
             {"exit_code", "zero"}, {"exit_code", -1}, {"message", 7}, {"seconds", Json::arrayValue}, {"values", 3}}) {
        Json::Value wrong = good;
        wrong[name] = value;
        write_text(folder / "out/jobs/0000.json", json_text(wrong));
        for (const char* option : {"--collect", "--resume"}) {
            const Outcome outcome = sweep({option});
            EXPECT_EQ(outcome.code, 1) << name;
            EXPECT_THAT(outcome.err, HasSubstr("out/jobs/0000.json': /" + name + ": expected ")) << name;
        }
    }
    write_text(folder / "out/jobs/0000.json", "[0]");
    EXPECT_THAT(sweep({"--collect"}).err, HasSubstr("out/jobs/0000.json' is no JSON object"));
    Json::Value manifest = read_json(folder / "out/runs/0000/manifest.json", {});
    manifest["statistics"][0]["frame"] = "first";
    std::filesystem::remove(folder / "out/jobs/0000.json");
    write_text(folder / "out/runs/0000/manifest.json", json_text(manifest));
    EXPECT_EQ(sweep({"--resume", "-q"}).code, 0) << "it is run again";
}

TEST_F(Sweep, SpecificationsOfWrongTypesAreWrongScenes) {
    for (const char* spec :
         {"[1]", "7", R"({"scene": 3, "count": 1})", R"({"scene": "scene.json", "count": "two"})",
          R"({"scene": "scene.json", "count": 1, "set": [1]})", R"({"scene": "scene.json", "count": 1, "vary": "all"})",
          R"({"scene": "scene.json", "count": 1, "vary": {"/a": 3}})",
          R"({"scene": "scene.json", "count": 1, "vary": {"/a": {"normal": ["x", 1]}}})",
          R"({"scene": "scene.json", "count": 1, "vary": {"/a": {"normal": [0, 1e-3], "within": "all"}}})",
          R"({"scene": "scene.json", "count": 1, "vary": {"/a": {"normal": [0, 1e-3], "within": [100, 101]}}})"}) {
        write_text(folder / "spec.json", spec);
        for (const std::vector<std::string>& more : {std::vector<std::string>{"--list"}, {"-q"}}) {
            const Outcome outcome = sweep(more);
            EXPECT_EQ(outcome.code, 3) << spec << outcome.err;
            EXPECT_THAT(outcome.err, testing::StartsWith("spec.json:1:")) << spec;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_F(Sweep, SomeRunsOfADataSetHaveItsDescription) {
    write_text(folder / "spec.json", R"({"scene": "scene.json", "seed": 2, "count": 9,
        "vary": {"/gravity/0": {"uniform": [-1, 1]}}})");
    ASSERT_EQ(sweep({"--dataset", "--index", "0-1"}).code, 0);
    const auto load = [&](const char* output) {
        return Running("/usr/bin/python3", {DRAPE_SOURCE_DIR "/tools/examples/sweep/load_dataset.py",
                                            (folder / output / "dataset").string()})
            .wait();
    };
    const Outcome loaded = load("out");
    EXPECT_EQ(loaded.code, 0) << loaded.err;
    EXPECT_THAT(loaded.out, HasSubstr("2 trajectories of 9 frames"));
    const std::string meta = file("out/dataset/meta.json");
    EXPECT_EQ(sweep({"--dataset", "--collect"}).code, 9);
    EXPECT_EQ(file("out/dataset/meta.json"), meta);
    // Trajectories of two lengths.
    write_text(folder / "spec.json", R"({"scene": "scene.json", "vary": {"/time/frames": {"grid": [3, 4]}}})");
    ASSERT_EQ(sweep({"--dataset", "--index", "1"}, "other").code, 0);
    EXPECT_EQ(read_json(folder / "other/dataset/meta.json", {})["trajectory_length"], Json::Value(-1));
    // Two lengths of a frame, and nodes in a hole.
    write_text(folder / "spec.json", R"({"scene": "scene.json", "set": {"/cloths/0/holes": [[[1, 1], [4, 4]]]},
        "vary": {"/time/fps": {"grid": [30, 60]}}})");
    ASSERT_EQ(sweep({"--dataset", "--export", "npz"}, "holed").code, 0);
    EXPECT_EQ(read_json(folder / "holed/dataset/meta.json", {})["dt"].asDouble(), -1);
    EXPECT_TRUE(std::filesystem::exists(folder / "holed/runs/0001/positions.npz"));
    const Outcome holed = load("holed");
    EXPECT_EQ(holed.code, 0) << holed.err;
    EXPECT_THAT(holed.out, HasSubstr("2 trajectories of 9 frames, not the same s apart"));
}

TEST_F(Sweep, WhatAKilledOneLeftIsNothing) {
    for (const char* place : {"out", "out/jobs"}) std::filesystem::create_directories(folder / place);
    const std::filesystem::path left = folder / "out/jobs/0000.json.tmp-4000000";
    write_text(left, "half");
    std::filesystem::remove_all(folder / "fresh");
    std::filesystem::create_directory(folder / "fresh");
    write_text(folder / "fresh/sweep.json.tmp-4000000", "half");
    EXPECT_EQ(sweep({"--index", "0"}, "fresh").code, 0);
    EXPECT_EQ(sweep({"-q"}).code, 9);
    EXPECT_TRUE(std::filesystem::exists(left)) << "young: another machine may be writing it";
    std::filesystem::remove_all(folder / "out/runs");
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out/jobs"))
        if (entry.path() != left) std::filesystem::remove(entry.path());
    std::filesystem::last_write_time(left, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    EXPECT_EQ(sweep({"-q"}).code, 9);
    EXPECT_FALSE(std::filesystem::exists(left));
}

}  // namespace
}  // namespace drape
