// A run's last frame is the next one's start, and what a scene takes from files decides what may be resumed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <algorithm>
#include <cmath>

#include "input/array_file.h"
#include "output/npy.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A cloth of 5 x 4 particles that hangs by its top from where another run, or a file, has it.
std::string hung(const std::string& where, int frames = 3) {
    return R"({"time": {"frames": )" + std::to_string(frames) + R"(}, "image": {"size": [64, 48], "samples": 1},
"solver": {"method": "line", "substeps": 4}, "cloths": [{"grid": [5, 4], "size": [1, 0.75], )" +
           where + R"(, "pins": [{"edge": "top"}]}]})";
}

const char* const level = R"("placement": {"origin": [-0.5, 1, 0], "v": [0, 0, 1]})";

std::vector<double> places(const fs::path& archive, bool last) {
    const input::Array array =
        input::load_array(archive, "positions", [](const input::Array& all) { return all.count(); });
    std::vector<double> values;
    for (std::size_t i = 0; i < 60; ++i) values.push_back(array.value(last ? array.count() - 60 + i : i));
    return values;
}

TEST(Given, TheLastFrameOfARunIsTheStartOfTheNext) {
    const SceneFolder folder(hung(level));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("first"), "-q", "--export", "npz,npy,obj,pc2"}).code,
              0);
    const std::vector<double> end = places(folder / "first/positions.npz", true);
    for (const char* file : {"positions.npz", "positions.npy", "positions.pc2", "mesh_0002.obj"}) {
        write_text(folder / "next.json", hung(R"("start": "first/)" + std::string(file) + "\""));
        const std::string scene = (folder / "next.json").string();
        ASSERT_EQ(drape({"check", scene}).code, 0);
        const Outcome run = drape({"simulate", scene, "-o", folder.out("next"), "-q", "--overwrite"});
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(places(folder / "next/positions.npz", false), end) << file;
        ASSERT_EQ(drape({"render", scene, "-o", folder.out("drawn"), "-q", "--overwrite", "-e", "1"}).code, 0);
    }
}

/// A sheet that swings down from its two upper corners, or goes on from where another run, or a file, has it.
std::string swung(const std::string& where, const std::string& method, int frames) {
    return R"({"time": {"frames": )" + std::to_string(frames) + R"(}, "solver": {"method": ")" + method +
           R"(", "substeps": 40}, "cloths": [{"grid": [9, 9], "size": [1, 1], "stiffness": {"stretch": 400, "shear": 60},)" +
           where + R"(, "pins": [{"corner": "top_left"}, {"corner": "top_right"}]}]})";
}

/// Returns the positions of a frame of a run of that sheet.
std::vector<double> frame_of(const fs::path& archive, std::size_t frame) {
    const input::Array array =
        input::load_array(archive, "positions", [](const input::Array& all) { return all.count(); });
    std::vector<double> values;
    for (std::size_t i = 0; i < 243; ++i) values.push_back(array.value(243 * frame + i));
    return values;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

// A method's first substep knows no springs' pull of the one before: what that is over ten frames is bounded here.
TEST(Given, ARunGoesOnWithItsMotion) {
    for (const char* method : {"relax", "explicit", "line"}) {
        const SceneFolder folder(swung(level, method, 31));
        const auto simulate = [&](const std::string& scene, const std::string& out, const std::string& last) {
            const Outcome run = drape({"simulate", scene, "-o", folder.out(out), "-q", "--export", "npz", "-e", last});
            ASSERT_EQ(run.code, 0) << run.err;
        };
        simulate(folder.scene(), "whole", "30");
        simulate(folder.scene(), "half", "20");
        const std::string start = R"("start": "half/positions.npz")";
        write_text(folder / "next.json", swung(start + R"(, "velocities": "half/positions.npz")", method, 11));
        write_text(folder / "still.json", swung(start, method, 11));
        simulate((folder / "next.json").string(), "next", "10");
        simulate((folder / "still.json").string(), "still", "10");
        const fs::path whole = folder / "whole/positions.npz";
        const std::vector<double> end = frame_of(whole, 30);
        EXPECT_EQ(frame_of(folder / "next/positions.npz", 0), frame_of(whole, 20));
        EXPECT_LT(farthest(frame_of(folder / "next/positions.npz", 10), end), 4e-3) << method;
        EXPECT_GT(farthest(frame_of(folder / "still/positions.npz", 10), end), 0.2) << method;
    }
}

TEST(Given, VelocitiesThatAreAllTheSameAreAVelocity) {
    const SceneFolder folder(swung(std::string(level) + R"(, "velocity": [0.5, 0.25, -1])", "line", 6));
    std::string values;
    for (int i = 0; i < 81; ++i)
        for (const float x : {0.5f, 0.25f, -1.0f}) values.append(reinterpret_cast<const char*>(&x), sizeof x);
    write_text(folder / "motion.npy", npy_header("<f4", "9, 9, 3") + values);
    write_text(folder / "each.json", swung(std::string(level) + R"(, "velocities": "motion.npy")", "line", 6));
    const std::string each = (folder / "each.json").string();
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("one"), "-q"}).code, 0);
    ASSERT_EQ(drape({"simulate", each, "-o", folder.out("each"), "-q"}).code, 0);
    EXPECT_EQ(read_text(folder / "one/positions.npy"), read_text(folder / "each/positions.npy"));
}

TEST(Given, WhatAFileHoldsDecidesWhatIsResumed) {
    const SceneFolder folder(hung(level));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("first"), "-q", "--export", "obj"}).code, 0);
    const auto take = [&](const char* from) {
        fs::copy_file(folder / "first" / from, folder / "shape.obj", fs::copy_options::overwrite_existing);
    };
    take("mesh_0001.obj");
    write_text(folder / "next.json", hung(R"("start": "shape.obj")"));
    const std::string scene = (folder / "next.json").string();
    ASSERT_EQ(drape({"render", scene, "-o", folder.out("next"), "-q"}).code, 0);
    fs::remove(folder / "next/manifest.json");
    fs::remove(folder / "next/frame_0001.png");
    fs::rename(folder / "shape.obj", folder / "same.obj");  // a name is not what counts, but the scene has it
    fs::copy_file(folder / "same.obj", folder / "shape.obj");
    EXPECT_EQ(drape({"render", scene, "-o", folder.out("next"), "-q", "--resume"}).code, 0);
    fs::remove(folder / "next/manifest.json");
    fs::remove(folder / "next/frame_0001.png");
    take("mesh_0002.obj");
    const Outcome other = drape({"render", scene, "-o", folder.out("next"), "-q", "--resume"});
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.err, HasSubstr("another run"));
}

TEST(Given, AFileThatIsNotThereIsAnErrorOfTheScene) {
    const SceneFolder folder(hung(R"("start": "none.npy", "maps": {"holes": "none.png"})"));
    for (const char* command : {"check", "simulate"}) {
        std::vector<std::string> words{command, folder.scene()};
        if (std::string(command) == "simulate")
            words.insert(words.end(), {"-o", folder.out(), "--device", "no such device"});
        const Outcome outcome = drape(words);
        EXPECT_EQ(outcome.code, 3);
        EXPECT_THAT(outcome.err + outcome.out,
                    AllOf(HasSubstr("/cloths/0/start: cannot read"), HasSubstr("/cloths/0/maps/holes: cannot read"),
                          HasSubstr("scene.json:2:")));
    }
    EXPECT_FALSE(fs::exists(folder.out()));
}

}  // namespace
}  // namespace drape
