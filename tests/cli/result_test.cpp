// A run leaves the same bytes every time, the frames that were asked for, and arrays that NumPy reads.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/vectors.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

void run(const std::vector<std::string>& arguments) {
    const Outcome outcome = drape(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
}

std::map<std::string, std::string> without_manifest(const fs::path& folder) {
    auto files = everything_below(folder);
    files.erase("manifest.json");
    return files;
}

TEST(Results, ARenderTwiceGivesTheSameBytes) {
    const SceneFolder folder(small_scene(12));
    run({"render", folder.scene(), "-o", folder.out("a"), "--samples", "4"});
    run({"render", folder.scene(), "-o", folder.out("b"), "--samples", "4", "-q"});
    const auto files = without_manifest(folder / "a");
    EXPECT_EQ(files.size(), 12u);
    EXPECT_EQ(files, without_manifest(folder / "b"));
    EXPECT_NE(files.at("frame_0000.png"), files.at("frame_0011.png"));
    EXPECT_EQ(lasting_manifest(folder / "a"), lasting_manifest(folder / "b"));
    EXPECT_EQ(lasting_manifest(folder / "a")["files"].size(), 12u);
}

TEST(Results, ASimulationTwiceGivesTheSameBytes) {
    const SceneFolder folder(small_scene(12));
    run({"simulate", folder.scene(), "-o", folder.out("a")});
    run({"simulate", folder.scene(), "-o", folder.out("b")});
    EXPECT_THAT(names_in(folder / "a"), ElementsAre("manifest.json", "positions.npy", "positions.npz"));
    EXPECT_EQ(without_manifest(folder / "a"), without_manifest(folder / "b"));
    EXPECT_EQ(lasting_manifest(folder / "a"), lasting_manifest(folder / "b"));
}

TEST(Results, FramesAreThoseAskedForAndTheirBytesDoNotDependOnIt) {
    const SceneFolder folder(small_scene(12));
    run({"render", folder.scene(), "-o", folder.out("all"), "-q"});
    run({"render", folder.scene(), "-o", folder.out("some"), "-s", "2", "-e", "10", "-j", "3", "-q"});
    EXPECT_THAT(frame_numbers(folder / "some"), ElementsAre(2, 5, 8));
    for (const int frame : {2, 5, 8})
        EXPECT_EQ(read_text(folder / "some" / frame_name(frame)), read_text(folder / "all" / frame_name(frame)));
    const Json::Value frames = lasting_manifest(folder / "some")["frames"];
    EXPECT_EQ(frames["start"].asInt(), 2);
    EXPECT_EQ(frames["end"].asInt(), 10);
    EXPECT_EQ(frames["step"].asInt(), 3);
    EXPECT_EQ(frames["count"].asInt(), 3);
}

TEST(Results, EveryFrameStatesItsStatistics) {
    const SceneFolder folder(small_scene(12));
    run({"render", folder.scene(), "-o", folder.out("pictures"), "-j", "5"});
    run({"simulate", folder.scene(), "-o", folder.out("arrays"), "-j", "5", "-q"});
    const Json::Value statistics = lasting_manifest(folder / "pictures")["statistics"];
    EXPECT_EQ(statistics, lasting_manifest(folder / "arrays")["statistics"]);
    ASSERT_EQ(statistics.size(), 3u);
    for (Json::ArrayIndex k = 0; k < 3; ++k) {
        EXPECT_EQ(statistics[k]["frame"].asInt(), 5 * static_cast<int>(k));
        for (const char* name :
             {"sheet/stretch_rms", "sheet/stretch_max", "sheet/shear_rms", "sheet/kinetic_energy_j",
              "sheet/momentum_y_kg_m_s", "sheet/angular_momentum_z_kg_m2_s", "sheet/angular_error_kg_m2_s",
              "kinetic_energy_j", "potential_energy_j", "elastic_energy_j", "energy_drift_j"})
            EXPECT_TRUE(statistics[k][name].isNumeric()) << name;
    }
    EXPECT_EQ(statistics[0]["energy_drift_j"].asDouble(), 0);
    EXPECT_GT(statistics[2]["sheet/stretch_rms"].asDouble(), statistics[0]["sheet/stretch_rms"].asDouble());
    EXPECT_GT(statistics[2]["sheet/stretch_max"].asDouble(), statistics[2]["sheet/stretch_rms"].asDouble());
    EXPECT_LT(statistics[2]["potential_energy_j"].asDouble(), statistics[0]["potential_energy_j"].asDouble());
}

/// Returns the vector whose coordinates have a name with x, y and z in the place of `#`.
Vec3 vector_of(const Json::Value& numbers, std::string name) {
    Vec3 vector{};
    const std::size_t at = name.find('#');
    for (std::size_t k = 0; k < 3; ++k) {
        name[at] = "xyz"[k];
        vector[k] = numbers[name].asDouble();
    }
    return vector;
}

TEST(Results, ForcesByMethodAutoAddUpToTheChangeOfMomentum) {
    const SceneFolder folder(R"({"time": {"fps": 60, "frames": 46}, "forces": true, "wind": {"velocity": [1, 0, 1]},
        "cloths": [{"name": "sheet", "grid": [13, 13], "size": [0.4, 0.4], "damping": 0.5,
                    "placement": {"origin": [-0.2, 0.3, -0.2], "u": [1, 0, 0], "v": [0, 0, 1]},
                    "pins": [{"box": [[0, 0], [3, 0]]}, {"at": [12, 0]}]}],
        "colliders": {"spheres": [{"center": [0, 0, 0.05], "radius": 0.1}]}})");
    run({"simulate", folder.scene(), "-o", folder.out("a"), "-q"});
    const Json::Value statistics = lasting_manifest(folder / "a")["statistics"];
    double touched = 0, worst = 0;
    for (Json::ArrayIndex k = 1; k < statistics.size(); ++k) {
        Vec3 sum{};
        double largest = 0;
        for (const char* by : {"gravity", "pins_0", "pins_1", "air", "damping", "collider_0_sphere"}) {
            const Vec3 force = vector_of(statistics[k], fmt::format("sheet/force_{}_#_n", by));
            sum = plus(sum, force);
            largest = std::max(largest, length(force));
        }
        const auto momentum = [&](Json::ArrayIndex of) { return vector_of(statistics[of], "sheet/momentum_#_kg_m_s"); };
        worst = std::max(worst, length(minus(sum, times(60, minus(momentum(k), momentum(k - 1))))) / largest);
        touched = std::max(touched, vector_of(statistics[k], "sheet/force_collider_0_sphere_#_n")[1]);
        EXPECT_TRUE(statistics[k]["sheet/moment_collider_0_sphere_x_n_m"].isNumeric());
    }
    EXPECT_EQ(statistics.size(), 46u);
    EXPECT_GT(touched, 0.01);
    EXPECT_LT(worst, 1e-4);
    EXPECT_FALSE(statistics[0].isMember("sheet/force_gravity_y_n"));
}

TEST(Results, NothingMovesInASleepingFrame) {
    const SceneFolder folder(R"({"time": {"fps": 20, "frames": 71}, "cloths": [{"name": "sheet", "grid": [9, 8],
        "size": [0.4, 0.3], "damping": 8,
        "pins": [{"edge": "top", "path": [{"t": 3}, {"t": 3.3, "translate": [0.1, 0, 0]}]}]}]})");
    run({"simulate", folder.scene(), "-o", folder.out(), "-q"});
    const Json::Value statistics = lasting_manifest(folder.out())["statistics"];
    std::size_t asleep = 0;
    for (const Json::Value& frame : statistics) {
        if (!frame.isMember("asleep")) continue;
        ++asleep;
        for (const char* name : {"kinetic_energy_j", "sheet/kinetic_energy_j", "sheet/speed_max_m_s"})
            EXPECT_EQ(frame[name].asDouble(), 0) << name;
        EXPECT_EQ(frame["energy_j"].asDouble(),
                  frame["potential_energy_j"].asDouble() + frame["elastic_energy_j"].asDouble());
    }
    EXPECT_GE(asleep, 5u);
    EXPECT_GT(statistics[statistics.size() - 1]["kinetic_energy_j"].asDouble(), 0) << "it was woken";
    const char* check = R"(
import numpy, sys
run = numpy.load(sys.argv[1])
asleep = run["asleep"] == 1
assert asleep.sum() >= 5 and not run["velocities"][asleep].any() and not run["speed_max_m_s"][asleep].any()
assert run["velocities"][~asleep].any(axis=(1, 2, 3))[1:].all()
)";
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy here";
    const Outcome outcome = Running("/usr/bin/python3", {"-c", check, (folder / "out/positions.npz").string()}).wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Results, TheProgressLineStatesTheStretch) {
    const SceneFolder folder(small_scene(2));
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out()});
    EXPECT_THAT(outcome.err, testing::ContainsRegex("ETA 0:00  stretch .* % RMS, .* % max, stretch error .* % RMS, "
                                                    "[0-9]+ substeps, energy .* J since frame 0, no penetration\n"));
}

TEST(Results, ATooLargeEndIsClampedWithAWarning) {
    const SceneFolder folder(small_scene(3));
    const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), "-e", "1000", "-s", "1", "-q"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "warning: the scene ends at frame 2: --end 1000 is clamped\n");
    EXPECT_THAT(frame_numbers(folder.out()), ElementsAre(1, 2));
}

TEST(Results, SizeAndSamplesReplaceTheScenes) {
    const SceneFolder folder(small_scene(1));
    run({"render", folder.scene(), "-o", folder.out(), "--size", "33x17", "--samples", "4"});
    EXPECT_TRUE(is_whole_picture(folder / "out/frame_0000.png", 33, 17));
    const Json::Value picture = lasting_manifest(folder.out())["picture"];
    EXPECT_EQ(picture["width"].asInt(), 33);
    EXPECT_EQ(picture["height"].asInt(), 17);
    EXPECT_EQ(picture["samples"].asInt(), 4);
}

TEST(Results, AnOverrideChangesTheResultAndIsRecorded) {
    const SceneFolder folder(small_scene(6));
    run({"simulate", folder.scene(), "-o", folder.out("a")});
    run({"simulate", folder.scene(), "-o", folder.out("b"), "--set", "/gravity=[0,-1.62,0]"});
    EXPECT_NE(read_text(folder / "a/positions.npy"), read_text(folder / "b/positions.npy"));
    const Json::Value scene = lasting_manifest(folder / "b")["scene"];
    EXPECT_EQ(scene["overrides"][0].asString(), "/gravity=[0,-1.62,0]");
    EXPECT_NE(scene["hash"], lasting_manifest(folder / "a")["scene"]["hash"]);
}

// A scene from a pipe can be read once only, so the text that is run is the one that is hashed.
TEST(Results, ASceneMayComeFromAPipe) {
    const SceneFolder folder(small_scene(2));
    run({"simulate", folder.scene(), "-o", folder.out("file")});
    const std::string command = "cat scene.json | '" DRAPE_PROGRAM "' simulate /dev/stdin -o pipe -q";
    EXPECT_EQ(Running("/bin/sh", {"-c", command}, {.folder = folder.path()}).wait().code, 0);
    EXPECT_EQ(read_text(folder / "pipe/positions.npy"), read_text(folder / "file/positions.npy"));
    EXPECT_EQ(lasting_manifest(folder / "pipe")["scene"]["hash"], lasting_manifest(folder / "file")["scene"]["hash"]);
}

TEST(Results, SeveralClothsGiveAnArrayEachThatNumPyReads) {
    const SceneFolder folder(R"({
  "time": {"fps": 60, "frames": 7}, "gravity": [0, -2, 0], "solver": {"method": "relax", "substeps": 4},
  "cloths": [{"name": "left", "grid": [8, 3], "size": [1, 0.5], "placement": {"origin": [-2, 1.5, 0.25]},
              "pins": [{"edge": "top"}]},
             {"name": "right", "grid": [4, 5], "size": [1, 1], "placement": {"origin": [1, 3, 0]}}]
})");
    run({"simulate", folder.scene(), "-o", folder.out(), "-j", "2"});
    EXPECT_THAT(names_in(folder.out()), ElementsAre("manifest.json", "positions_left.npy", "positions_left.npz",
                                                    "positions_right.npy", "positions_right.npz"));
    EXPECT_THAT(read_text(folder / "out/positions_left.npy"), HasSubstr("'shape': (4, 3, 8, 3)"));
    const std::string python = "/usr/bin/python3";
    if (access(python.c_str(), X_OK) != 0 || Running(python, {"-c", "import numpy"}).wait().code != 0)
        GTEST_SKIP() << "no NumPy here";
    const std::string script = R"(
import numpy
left, right = (numpy.load('out/positions_%s.npy' % name) for name in ('left', 'right'))
print(left.dtype, left.shape, right.dtype, right.shape)
print(left[0, 0, 0].tolist(), left[0, 2, 7].tolist(), right[0, 4, 0].tolist())
print(bool(numpy.isfinite(left).all()), bool((left[:, 0] == left[0, 0]).all()))
print(round(float(right[0, 0, 0, 1] - right[3, 0, 0, 1]), 3))
)";
    const Outcome read = Running(python, {"-c", script}, {.folder = folder.path()}).wait();
    EXPECT_EQ(read.code, 0) << read.err;
    // The free cloth has fallen 1/2 2 m/s^2 (0.1 s)^2 = 0.01 m; the pinned row has not moved.
    EXPECT_EQ(read.out,
              "float32 (4, 3, 8, 3) float32 (4, 5, 4, 3)\n"
              "[-2.0, 1.5, 0.25] [-1.0, 1.0, 0.25] [1.0, 2.0, 0.0]\n"
              "True True\n"
              "0.01\n");
}

}  // namespace
}  // namespace drape
