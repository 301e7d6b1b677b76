// SIGINT and SIGTERM let frames in flight finish: pictures are whole, and the folder does not look done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr int endless = 9000;  // frames: minutes of work

struct Stop {
    int signal, code;
    const char* name;
};

class Signals : public testing::TestWithParam<Stop> {};

TEST_P(Signals, EndARenderWithWholePicturesAndNoManifest) {
    const SceneFolder folder(small_scene(endless));
    Running program(DRAPE_PROGRAM, {"render", folder.scene(), "-o", folder.out()});
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(folder / "out/frame_0003.png"); })) << program.wait().err;
    program.send(GetParam().signal);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.code, GetParam().code);
    EXPECT_FALSE(outcome.by_signal);
    EXPECT_THAT(outcome.err, HasSubstr(std::string("drape: stopped by ") + GetParam().name));
    EXPECT_THAT(outcome.err, HasSubstr("no manifest was written"));
    const std::set<int> frames = frame_numbers(folder.out());
    // There is no manifest and no unfinished file, only the two files that the run goes on from.
    EXPECT_EQ(names_in(folder.out()).size(), frames.size() + 2);
    EXPECT_TRUE(names_in(folder.out()).contains("journal.drape"));
    EXPECT_LT(frames.size(), static_cast<std::size_t>(endless));
    int next = 0;
    for (const int frame : frames) {
        EXPECT_EQ(frame, next++);  // frames in flight were finished, so there are no gaps
        EXPECT_TRUE(is_whole_picture(folder / "out" / frame_name(frame), 64, 48)) << frame;
    }
}

TEST_P(Signals, EndASimulationWithoutItsIncompleteArray) {
    const SceneFolder folder(small_scene(endless));
    Running program(DRAPE_PROGRAM, {"simulate", folder.scene(), "-o", folder.out()});
    const auto has_data = [&] {
        if (!fs::exists(folder.out())) return false;
        for (const auto& entry : fs::directory_iterator(folder.out()))
            if (entry.file_size() > 1000) return true;
        return false;
    };
    ASSERT_TRUE(program.wait_until(has_data)) << program.wait().err;
    program.send(GetParam().signal);
    EXPECT_EQ(program.wait().code, GetParam().code);
    EXPECT_THAT(names_in(folder.out()), ElementsAre(StartsWith("checkpoint_"), "journal.drape"));
}

INSTANTIATE_TEST_SUITE_P(Both, Signals, testing::Values(Stop{SIGINT, 130, "SIGINT"}, Stop{SIGTERM, 143, "SIGTERM"}),
                         [](const auto& test) { return std::string(test.param.name); });

/// A frame of these takes longer than anybody waits; the signal comes within it.
struct Long {
    const char *name, *scene, *says;
};
class SignalsWithinAFrame : public testing::TestWithParam<Long> {};

TEST_P(SignalsWithinAFrame, AreAnsweredInTwoSeconds) {
    const SceneFolder folder(GetParam().scene);
    Running program(DRAPE_PROGRAM, {"simulate", folder.scene(), "-o", folder.out()});
    const auto writes = [&] { return fs::exists(folder.out()) && !fs::is_empty(folder.out()); };
    ASSERT_TRUE(program.wait_until(writes)) << program.wait().err;
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    program.send(SIGTERM);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.code, 143) << outcome.err;
    EXPECT_FALSE(outcome.by_signal);
    EXPECT_THAT(outcome.err, HasSubstr(std::string("drape: stopped by SIGTERM") + GetParam().says));
    // A run that begins again takes no notice of leftovers.
    EXPECT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-e", "0", "-q", "--resume"}).code, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SignalsWithinAFrame,
    testing::Values(Long{"ManyAttempts", R"({"time": {"fps": 60, "frames": 30}, "wind": {"velocity": [5000, 0, 500]},
        "cloths": [{"grid": [120, 120], "size": [1, 1], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "left"}]}]})",
                         ""},
                    Long{"OneSubmit", R"({"time": {"fps": 60, "frames": 30},
        "cloths": [{"grid": [700, 700], "size": [1, 1], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "left"}]}],
        "solver": {"method": "explicit", "substeps": 4096}})",
                         ", without waiting for what takes longer than two seconds"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace drape
