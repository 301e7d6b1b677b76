// A folder that is not empty or cannot be made is refused; --overwrite replaces a run and keeps foreign files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/vfs.h>

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

TEST(OutputFolderOption, WhatAKilledRunLeftIsNothing) {
    for (const char* option : {"-q", "--overwrite", "--resume"}) {
        const SceneFolder folder(small_scene(3));
        fs::create_directory(folder / "out");
        write_text(folder / "out/frame_0001.png.tmp-4000000", "half");
        const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), option});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(names_in(folder.out()),
                    ElementsAre("frame_0000.png", "frame_0001.png", "frame_0002.png", "manifest.json"));
    }
}

TEST(OutputFolderOption, ARunThatCannotFitIsRefusedBeforeItBegins) {
    const SceneFolder folder(small_scene(2));
    struct statfs status {};
    ASSERT_EQ(statfs(folder.path().c_str(), &status), 0);
    const bool known = status.f_type == 0xef53 || status.f_type == 0x58465342 || status.f_type == 0x01021994;
    if (!known) GTEST_SKIP() << "the free space of this file system says little";
    const auto simulate = [&](const char* frames) {
        return drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set", "/cloths/0/grid=[900,900]",
                      "--set", std::string("/time/frames=") + frames});
    };
    const Outcome outcome = simulate("1000000");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("output folder '" + folder.out() + "' has room for "),
                                   HasSubstr("the run would write 51840.0 GB")));
    EXPECT_FALSE(fs::exists(folder / "out"));
    EXPECT_EQ(simulate("1").code, 0);
}

/// Files of such names are made, and what is said and written of them is read as UTF-8 and as JSON.
TEST(FileNames, OfAnyBytesAreEscapedWhereverTheyAreToldOf) {
    const SceneFolder folder(small_scene(2));
    const std::string name = "a\xff\nb", shown = "a\\xff\\x0ab";
    fs::copy_file(folder.scene(), folder / (name + ".json"));
    const auto run = [&](std::vector<std::string> arguments) { return drape(arguments, {.folder = folder.path()}); };
    const auto is_json = [&](const std::string& text) {
        write_text(folder / "text", text);
        const char* check = "import json, sys; json.loads(open(sys.argv[1], 'rb').read().decode('utf-8'))";
        return Running("/usr/bin/python3", {"-c", check, (folder / "text").string()}).wait().code == 0;
    };
    const Outcome made = run({"simulate", name + ".json", "-o", name});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("2 frames in " + shown + "\n"));
    EXPECT_TRUE(is_json(read_text(folder / (name + "/manifest.json"))));
    EXPECT_THAT(run({"simulate", "scene.json", "-o", name}).err,
                AllOf(HasSubstr("output folder '" + shown + "' is not empty"), testing::EndsWith("folder\n")));
    EXPECT_THAT(run({"render", name, "-o", "x"}).err, HasSubstr(shown + ": "));
    EXPECT_THAT(run({"render", "scene.json", "-o", "x", "--no" + name}).err, HasSubstr("not expected: --no" + shown));
    EXPECT_THAT(run({"check", name + ".json"}).out, HasSubstr(shown + ".json: ok\n"));
    EXPECT_TRUE(is_json(run({"check", name + ".json", "--json"}).out));
    const std::vector<std::string> verify{"verify", name + ".json", "--no-validate", "--junit", "junit.xml", "--json"};
    EXPECT_TRUE(is_json(run(verify).out));
    EXPECT_EQ(Running("/usr/bin/python3", {"-c", "import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])",
                                           (folder / "junit.xml").string()})
                  .wait()
                  .code,
              0);
    write_text(folder / (name + ".npy"), "no array");
    EXPECT_THAT(run({"compare", name + ".npy", name + ".npy"}).err, HasSubstr("'" + shown + ".npy'"));
    EXPECT_THAT(run({"report", name}).err, testing::StartsWith(shown + "/report.html ("));
}

}  // namespace
}  // namespace drape
