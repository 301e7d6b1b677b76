// Data go to stdout and messages to stderr, and the run ends properly when one of them cannot be written.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace fs = std::filesystem;

TEST(Streams, ARunSaysNothingOnStdoutAndQuietSaysNothing) {
    const SceneFolder folder(small_scene(2));
    const Outcome normal = drape({"render", folder.scene(), "-o", folder.out("a")});
    EXPECT_EQ(normal.code, 0);
    EXPECT_THAT(normal.out, IsEmpty());
    EXPECT_THAT(normal.err, AllOf(HasSubstr("frame 1 (2/2, 100 %)"), HasSubstr("2 frames in " + folder.out("a"))));
    EXPECT_THAT(normal.err, Not(HasSubstr("\x1b")));  // without a terminal there are no escape sequences
    const Outcome quiet = drape({"render", folder.scene(), "-o", folder.out("b"), "-q"});
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Streams, VerboseNamesDeviceDriverPlanAndMemory) {
    const SceneFolder folder(small_scene(2));
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-v"});
    EXPECT_EQ(outcome.code, 0);
    const Json::Value device = lasting_manifest(folder.out())["device"];
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr(device["name"].asString()), HasSubstr(device["driver_version"].asString()),
                      HasSubstr(device["uuid"].asString()), HasSubstr("48 particles, 4 substeps x 1 iterations"),
                      testing::ContainsRegex("plan: [0-9]+ passes, [0-9]+ barriers"),
                      testing::ContainsRegex("device memory: [0-9.]+ [KMG]iB of at most [0-9.]+ [KMG]iB")));
}

TEST(Streams, AGraphIsDataInEveryFormat) {
    const SceneFolder folder(small_scene(2));
    for (const auto& [format, begin] : {std::pair{"text", "passes: "}, {"json", "{"}, {"dot", "digraph "}}) {
        const Outcome outcome = drape({"graph", folder.scene(), "--format", format});
        EXPECT_EQ(outcome.code, 0) << format;
        EXPECT_THAT(outcome.err, IsEmpty()) << format;
        EXPECT_THAT(outcome.out, testing::StartsWith(begin)) << format;
    }
    EXPECT_THAT(drape({"graph", folder.scene()}).out, HasSubstr("raster"));
    EXPECT_THAT(drape({"graph", folder.scene(), "--simulate"}).out, HasSubstr("no picture is wanted"));
}

TEST(Streams, AFullOrClosedStdoutIsAnError) {
    const SceneFolder folder(small_scene(2));
    const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
    ASSERT_GE(full, 0);
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"schema"},
                                                      {"devices"},
                                                      {"graph", folder.scene()},
                                                      {"check", folder.scene()},
                                                      {"--help"}}) {
        const Outcome on_full = drape(arguments, {.stdout_descriptor = full});
        EXPECT_EQ(on_full.code, 1) << arguments[0];
        EXPECT_EQ(on_full.err, "drape: cannot write to 'stdout': No space left on device\n") << arguments[0];
        const Outcome on_closed = drape(arguments, {.close_stdout = true});
        EXPECT_EQ(on_closed.code, 1) << arguments[0];
        EXPECT_EQ(on_closed.err, "drape: cannot write to 'stdout': Bad file descriptor\n") << arguments[0];
    }
    close(full);
}

TEST(Streams, AReaderThatLeftEndsItWithoutAWord) {
    int ends[2];
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    close(ends[0]);
    const Outcome outcome = drape({"schema"}, {.stdout_descriptor = ends[1]});
    close(ends[1]);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_FALSE(outcome.by_signal);
    EXPECT_THAT(outcome.err, IsEmpty());
}

// A file opened while stdout or stderr is closed would get its number, and the messages written to it.
TEST(Streams, ClosedOnesAreNotGivenToFiles) {
    const SceneFolder folder(small_scene(9000));
    Running program(DRAPE_PROGRAM, {"render", folder.scene(), "-o", folder.out(), "-v"},
                    {.close_stdout = true, .close_stderr = true});
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(folder / "out/frame_0001.png"); }));
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        EXPECT_EQ(fs::read_symlink(fmt::format("/proc/{}/fd/{}", program.id(), stream)), "/dev/null");
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().code, 143);
}

}  // namespace
}  // namespace drape
