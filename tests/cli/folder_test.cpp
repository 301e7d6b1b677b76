// A folder that is not empty or cannot be made is refused; --overwrite replaces a run and keeps foreign files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(OutputFolderOption, ANonEmptyFolderIsRefused) {
    const SceneFolder folder(small_scene(2));
    fs::create_directory(folder / "out");
    write_text(folder / "out/thesis.tex", "years of work");
    const auto before = everything_below(folder.path());
    const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("is not empty (it holds thesis.tex)"), HasSubstr("--overwrite"),
                                   HasSubstr("--resume")));
    EXPECT_EQ(everything_below(folder.path()), before);
}

// Tests may run as root, whom permissions do not stop; /proc takes no folders from anyone.
TEST(OutputFolderOption, AFolderThatCannotBeMadeIsRefused) {
    const SceneFolder folder(small_scene(2));
    const auto before = everything_below(folder.path());
    for (const std::string& path : {std::string("/proc/drape/out"), folder.scene(), folder.scene() + "/out"}) {
        const Outcome outcome = drape({"render", folder.scene(), "-o", path});
        EXPECT_EQ(outcome.code, 1) << path;
        EXPECT_THAT(outcome.err, AllOf(testing::StartsWith("drape: "), HasSubstr("output folder"))) << path;
    }
    EXPECT_EQ(everything_below(folder.path()), before);
}

TEST(OutputFolderOption, OverwriteReplacesARunAndKeepsForeignFiles) {
    const SceneFolder folder(small_scene(5));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    ASSERT_EQ(frame_numbers(folder.out()).size(), 5u);
    write_text(folder / "out/notes.txt", "mine");
    // A run that fails while starting loses nothing.
    const auto before = everything_below(folder.path());
    EXPECT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "--overwrite", "--device", "none such"}).code, 4);
    EXPECT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "--overwrite", "-s", "9"}).code, 2);
    EXPECT_EQ(everything_below(folder.path()), before);

    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q", "--overwrite", "-e", "1"}).code, 0);
    EXPECT_THAT(names_in(folder.out()), ElementsAre("frame_0000.png", "frame_0001.png", "manifest.json", "notes.txt"));
    EXPECT_EQ(read_text(folder / "out/notes.txt"), "mine");
    EXPECT_EQ(read_text(folder / "out/frame_0001.png"), before.at("out/frame_0001.png"));
}

}  // namespace
}  // namespace drape
