// --resume makes an unfinished run, byte for byte, the run that was never disturbed, or changes nothing.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A file that was written anew has another inode number.
ino_t file_number(const fs::path& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) throw std::runtime_error("no file " + path.string());
    return status.st_ino;
}

class Resume : public testing::TestWithParam<int> {};

TEST_P(Resume, GivesTheBytesOfAnUndisturbedRun) {
    const SceneFolder folder(small_scene(9000));
    {
        Running program(DRAPE_PROGRAM, {"render", folder.scene(), "-o", folder.out(), "-q"});
        ASSERT_TRUE(program.wait_until([&] { return fs::exists(folder / "out/frame_0005.png"); }))
            << program.wait().err;
        program.send(GetParam());
        ASSERT_EQ(program.wait().code, 128 + GetParam());
    }
    // This makes a gap, whatever the moment of the signal.
    fs::remove(folder / "out/frame_0003.png");
    std::map<int, ino_t> kept;
    for (const int frame : frame_numbers(folder.out())) kept[frame] = file_number(folder / "out" / frame_name(frame));
    ASSERT_GE(kept.size(), 3u);
    const int last = kept.rbegin()->first + 4;
    const std::string end = std::to_string(last);

    // Hard links keep the kept files' numbers from being given to new ones.
    fs::create_directory(folder / "links");
    for (const auto& [frame, number] : kept)
        fs::create_hard_link(folder / "out" / frame_name(frame), folder / "links" / frame_name(frame));
    const Outcome resumed = drape({"render", folder.scene(), "-o", folder.out(), "-e", end, "--resume"});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr(fmt::format("({} of them kept)", kept.size())));
    for (const auto& [frame, number] : kept)
        EXPECT_EQ(file_number(folder / "out" / frame_name(frame)), number) << frame;

    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out("whole"), "-e", end, "-q"}).code, 0);
    EXPECT_EQ(lasting_manifest(folder.out()), lasting_manifest(folder.out("whole")));
    auto files = everything_below(folder.out()), whole = everything_below(folder.out("whole"));
    files.erase("manifest.json");
    whole.erase("manifest.json");
    EXPECT_EQ(whole.size(), static_cast<std::size_t>(last) + 1);
    EXPECT_EQ(files, whole);
}
INSTANTIATE_TEST_SUITE_P(After, Resume, testing::Values(SIGINT, SIGKILL),
                         [](const auto& test) { return std::string(test.param == SIGINT ? "SIGINT" : "SIGKILL"); });

TEST(ResumeGuard, AnotherRunsPicturesAreRefusedAndNothingIsLost) {
    const SceneFolder folder(small_scene(3));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    fs::remove(folder / "out/manifest.json");
    fs::remove(folder / "out/frame_0001.png");
    const auto before = everything_below(folder.out());
    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"render", folder.scene(), "-o", folder.out(), "--resume"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = drape(arguments);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_EQ(everything_below(folder.out()), before);
        return outcome.err;
    };
    const auto of_another =
        AllOf(HasSubstr("cannot resume: '" + folder.out() + "/frame_0000.png' was drawn by another run"),
              HasSubstr("--overwrite"));
    EXPECT_THAT(refused({"--set", "/solver/substeps=5"}), of_another);
    EXPECT_THAT(refused({"--size", "64x49"}), of_another);
    EXPECT_THAT(refused({"--samples", "4"}), of_another);
    const std::string scene = read_text(folder.scene());
    write_text(folder.scene(), scene + " ");
    EXPECT_THAT(refused({}), of_another);
    write_text(folder.scene(), scene);
    EXPECT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "--resume", "-q"}).code, 0);
    EXPECT_EQ(frame_numbers(folder.out()), (std::set<int>{0, 1, 2}));
}

TEST(ResumeGuard, ADamagedPictureIsRefusedAndNothingIsLost) {
    const SceneFolder folder(small_scene(3));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    std::string picture = read_text(folder / "out/frame_0002.png");
    picture[picture.size() / 2] ^= 1;
    write_text(folder / "out/frame_0002.png", picture);
    const auto before = everything_below(folder.out());
    const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), "--resume"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("frame_0002.png' is damaged"));
    EXPECT_EQ(everything_below(folder.out()), before);
}

TEST(ResumeGuard, AnotherScenesArraysAreRefusedAndNothingIsLost) {
    const SceneFolder folder(small_scene(3));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    const auto before = everything_below(folder.out());
    const Outcome other = drape({"simulate", folder.scene(), "-o", folder.out(), "--resume", "--set", "/time/fps=30"});
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.err, HasSubstr("manifest.json' is that of another run"));
    EXPECT_EQ(everything_below(folder.out()), before);
    EXPECT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "--resume", "-q"}).code, 0);
    EXPECT_EQ(everything_below(folder.out()).at("positions.npy"), before.at("positions.npy"));
}

TEST(ResumeGuard, OfNothingIsARun) {
    const SceneFolder folder(small_scene(2));
    EXPECT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "--resume", "-q"}).code, 0);
    EXPECT_TRUE(fs::exists(folder / "out/manifest.json"));
}

}  // namespace
}  // namespace drape
