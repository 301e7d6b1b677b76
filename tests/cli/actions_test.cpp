// Scenes with actions, from the command line: killed runs go on to the bytes of runs that nobody disturbed, fields of
// forces among them, and what cannot be told is an error of the scene that touches nothing.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "input/array_file.h"
#include "output/output_folder.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// Cloth beside a ball: a hand takes a corner, wind begins, the ball goes, the hand lets go. It tells fields of forces.
std::string told_scene(const std::string& steps, const std::string& solver, int frame_count = 9000) {
    return fmt::format(R"({{"time": {{"frames": {}}}, "image": {{"size": [48, 32], "samples": 1}}, "forces": "fields",
"cloths": [{{"name": "sheet", "grid": [9, 8], "size": [0.4, 0.35], "placement": {{"origin": [0, 1, 0]}},
             "pins": [{{"corner": "top_left"}}]}}],
"colliders": {{"spheres": [{{"center": [0.2, 0.8, -0.12], "radius": 0.1}}]}},
"solver": {},
"actions": {{"controls": ["wind", "colliders", "holds"], "hands": ["sheet"], "steps": [
{}]}}
}})",
                       frame_count, solver, steps);
}

const std::string good_steps = R"({"frame": 2, "hands": [[0.4, 1, 0]], "grasps": [[8, 0]]},
{"frame": 3, "hands": [[0.4, 1.01, 0]], "wind": [0, 0, 1.5]},
{"frame": 6, "colliders": [[0, 0, 0.02]]},
{"frame": 9, "grasps": [[-1, -1]]},
{"frame": 14, "holds": [false]})";

class KilledActions : public testing::TestWithParam<const char*> {};

TEST_P(KilledActions, EndWithTheBytesOfAnUnbrokenRun) {
    const SceneFolder folder(told_scene(good_steps, fmt::format(R"({{"method": "{}"}})", GetParam())));
    for (const char* command : {"simulate", "render"}) {
        SCOPED_TRACE(command);
        std::vector<std::string> arguments{command, folder.scene(), "--export", "npz,npy,vtu", "-q"}, into = arguments;
        const std::string out = folder.out(std::string("killed_") + command),
                          whole = folder.out(std::string("whole_") + command);
        into.insert(into.end(), {"-o", out});
        std::vector<std::string> killed = into;
        killed.insert(killed.end(), {"--checkpoint", "0"});
        const auto newest = [&] {
            int frame = 0;
            for (const std::string& name : names_in(out))
                if (name.starts_with("checkpoint_") && name.ends_with(".drape"))
                    frame = std::max(frame, std::stoi(name.substr(11)));
            return frame;
        };
        Running program(DRAPE_PROGRAM, killed);
        ASSERT_TRUE(program.wait_until([&] { return fs::exists(out) && newest() >= 4; })) << program.wait().err;
        program.send(SIGKILL);
        ASSERT_EQ(program.wait().code, 128 + SIGKILL);
        const std::string end = std::to_string(std::max(newest() + 4, 18));
        into.insert(into.end(), {"--resume", "-e", end});
        const Outcome resumed = drape(into);
        ASSERT_EQ(resumed.code, 0) << resumed.err;
        arguments.insert(arguments.end(), {"-o", whole, "-e", end});
        ASSERT_EQ(drape(arguments).code, 0);
        EXPECT_EQ(lasting_manifest(out), lasting_manifest(whole));
        auto files = everything_below(out), expected = everything_below(whole);
        files.erase("manifest.json"), expected.erase("manifest.json");
        EXPECT_EQ(files, expected);
        EXPECT_TRUE(files.contains("tension.npy") && files.contains("contact_force.npy"));
    }
}
INSTANTIATE_TEST_SUITE_P(By, KilledActions, testing::Values("line", "auto"),
                         [](const auto& each) { return std::string(each.param); });

/// The archive's arrays of forces are what one expects of them: shapes, zeros where nothing is, and springs as bits.
TEST(FieldsOfForces, AreInTheArchive) {
    const SceneFolder folder(told_scene(good_steps, R"({"method": "line", "substeps": 8})", 15));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "--export", "npz,vtu", "-q"}).code, 0);
    const auto load = [&](const char* name, std::size_t size) {
        const input::Array array =
            input::load_array(folder / "out/positions.npz", name, [](const input::Array& all) { return all.count(); });
        EXPECT_EQ(array.count(), size) << name;
        return array;
    };
    const input::Array springs = load("springs", 72), tension = load("tension", 15 * 72 * 4);
    load("contact_force", 15 * 72 * 3);
    EXPECT_EQ(springs.value(0), 1 + 2 + 4);
    EXPECT_EQ(springs.value(8), 2 + 8);
    EXPECT_EQ(springs.value(71), 0);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(tension.value(4 * 72 * 4 + 71 * 4 + k), 0);
    double most = 0;
    for (std::size_t k = 0; k < 4 * 72; ++k) most = std::max(most, tension.value(4 * 72 * 4 + k));
    EXPECT_GT(most, 0) << "what hangs pulls";
    const auto files = everything_below(folder.out());
    for (const char* name : {"\"tension\" NumberOfComponents=\"4\"", "\"contact_force\" NumberOfComponents=\"3\"",
                             "\"springs\" NumberOfComponents=\"1\""})
        EXPECT_THAT(files.at("mesh_0004.vtu"), HasSubstr(name));
}

struct BadActions {
    const char* name;
    std::string steps, message;
    bool is_seen_by_check = true;  ///< or else only where it is played
};
void PrintTo(const BadActions& each, std::ostream* out) { *out << each.name; }
class BadActionsTest : public testing::TestWithParam<BadActions> {};

TEST_P(BadActionsTest, AreRefusedWithTheirPlaceAndNothingIsTouched) {
    const SceneFolder folder(told_scene(GetParam().steps, R"({"method": "line"})", 20));
    const auto before = everything_below(folder.path());
    for (const char* command : {"check", "simulate", "render"}) {
        const bool only_checks = std::string_view(command) == "check";
        std::vector<std::string> arguments{command, "scene.json"};
        if (!only_checks) arguments.insert(arguments.end(), {"-o", "out"});
        if (only_checks && !GetParam().is_seen_by_check) continue;
        const Outcome outcome = drape(arguments, {.folder = folder.path()});
        EXPECT_EQ(outcome.code, 3) << command;
        EXPECT_THAT(outcome.err, HasSubstr("scene.json:" + GetParam().message)) << command;
        EXPECT_EQ(everything_below(folder.path()), before) << command;
    }
}
INSTANTIATE_TEST_SUITE_P(
    Of, BadActionsTest,
    testing::Values(
        BadActions{"Controls", R"({"frame": 1, "gravity": [0, -1, 0]})",
                   R"(7:25: /actions/steps/0/gravity: expected "gravity" among the controls of actions, got it not)"},
        BadActions{"Order", R"({"frame": 4, "wind": [0, 0, 1]}, {"frame": 4}
)",
                   "7:44: /actions/steps/1/frame: expected a frame after that of the entry before, 4, got 4"},
        BadActions{"Frames", R"({"frame": 20, "wind": [0, 0, 1]})",
                   "7:11: /actions/steps/0/frame: expected a frame of the scene, whose last one is 19, got 20"},
        BadActions{"Numbers", R"({"frame": 1, "wind": [0, 1]})", "7:22: /actions/steps/0/wind: expected"},
        BadActions{"Count", R"({"frame": 1, "hands": [[0, 1, 0], [0, 1, 0]]})",
                   "7:23: /actions/steps/0/hands: expected 1 entries, got 2"},
        BadActions{"Particles", R"({"frame": 1, "hands": [[0, 1, 0]], "grasps": [[9, 0]]})",
                   "7:47: /actions/steps/0/grasps/0: expected particles of cloth \"sheet\", which has 9 columns and 8 "
                   "rows, got"},
        BadActions{"Jump",
                   R"({"frame": 1, "hands": [[0, 1, 0]], "grasps": [[8, 0]]},
{"frame": 2, "hands": [[0, 9, 0]]})",
                   "8:1: /actions/steps/1: frame 2: actions: member 0: hands: hand 0 holds cloth and jumps 8 m in a "
                   "step",
                   false},
        BadActions{"Taken", R"({"frame": 1, "hands": [[0, 1, 0]], "grasps": [[0, 0]]})",
                   "7:1: /actions/steps/0: frame 1: actions: member 0: grasps: hand 0 takes what pin 0 holds", false}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace drape
