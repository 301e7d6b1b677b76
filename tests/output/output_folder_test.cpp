#include "output/output_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "output/atomic_file.h"
#include "output/manifest.h"
#include "temporary_folder.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

std::string open_error(const fs::path& path, ExistingFiles existing = ExistingFiles::refuse) {
    return error_text<OutputError>([&] { OutputFolder folder(path, existing); });
}

void write_byte(OutputFolder& folder, const std::string& name) { write_file(folder, name, bytes_of("x")); }

TEST(OutputFolder, CreatesMissingParents) {
    const TemporaryFolder temporary;
    {
        OutputFolder folder(temporary / "a/b/c");
        write_byte(folder, "frame_0000.png");
    }
    EXPECT_THAT(names_in(temporary / "a/b/c"), ElementsAre("frame_0000.png"));
}

TEST(OutputFolder, LeavesNothingWhenNothingWasWritten) {
    const TemporaryFolder temporary;
    {
        OutputFolder folder(temporary / "a/b/");
        EXPECT_TRUE(fs::is_directory(temporary / "a/b"));
    }
    EXPECT_THAT(names_in(temporary.path()), IsEmpty());
}

TEST(OutputFolder, LeavesAnExistingEmptyFolder) {
    const TemporaryFolder temporary;
    fs::create_directory(temporary / "mine");
    { OutputFolder folder(temporary / "mine/new"); }
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("mine"));
    EXPECT_THAT(names_in(temporary / "mine"), IsEmpty());
}

TEST(OutputFolder, RefusesANonEmptyFolderNamingTheOptions) {
    const TemporaryFolder temporary;
    write_text(temporary / "thesis.tex", "x");
    write_text(temporary / "zebra", "x");
    EXPECT_THAT(open_error(temporary.path()),
                AllOf(HasSubstr("'" + temporary.path().string() + "' is not empty"), HasSubstr("thesis.tex and 1 more"),
                      HasSubstr("--overwrite"), HasSubstr("--resume")));
}

TEST(OutputFolder, WhatAKilledRunLeftIsNothingAndGoesAtTheFirstWrite) {
    for (const ExistingFiles existing : {ExistingFiles::refuse, ExistingFiles::overwrite, ExistingFiles::resume}) {
        const TemporaryFolder temporary;
        write_text(temporary / "frame_0003.png.tmp-4000000", "half");
        write_text(temporary / "manifest.json.tmp-1", "half");
        {
            OutputFolder folder(temporary.path(), existing);
            EXPECT_THAT(folder.files_to_remove(), ElementsAre("frame_0003.png.tmp-4000000", "manifest.json.tmp-1"));
            write_byte(folder, "frame_0000.png");
        }
        EXPECT_THAT(names_in(temporary.path()), ElementsAre("frame_0000.png"));
    }
    const TemporaryFolder temporary;
    write_text(temporary / "frame_0003.png.tmp-4000000", "half");
    write_text(temporary / "thesis.tex.tmp-4000000", "no file of ours");
    EXPECT_THAT(open_error(temporary.path()), HasSubstr("it holds thesis.tex.tmp-4000000)"));
    EXPECT_TRUE(is_left_over("thesis.tex.tmp-4000000")) << "no process has this number";
    EXPECT_FALSE(is_left_over(fmt::format("thesis.tex.tmp-{}", getpid())));
    EXPECT_FALSE(is_left_over("thesis.tex"));
}

TEST(OutputFolder, RefusesARunThatIsKnownNotToFit) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    folder.expect_room(1);
    struct statfs status {};
    ASSERT_EQ(statfs(temporary.path().c_str(), &status), 0);
    const bool known = status.f_type == 0xef53 || status.f_type == 0x58465342 || status.f_type == 0x01021994;
    if (!known) GTEST_SKIP() << "the free space of this file system says little";
    const std::uint64_t room = fs::space(temporary.path()).free;
    folder.expect_room(room / 2);
    EXPECT_THAT(error_text<OutputError>([&] { folder.expect_room(room + (std::uint64_t{1} << 40)); }),
                AllOf(HasSubstr(temporary.path().string()), HasSubstr(" GB, and the run would write ")));
}

TEST(OutputFolder, RefusesWhatIsNoFolder) {
    const TemporaryFolder temporary;
    write_text(temporary / "file", "x");
    fs::create_symlink("nowhere", temporary / "broken");
    fs::create_symlink("loop", temporary / "loop");
    EXPECT_THAT(open_error(temporary / "file"), HasSubstr("/file' is a file, not a folder"));
    EXPECT_THAT(open_error(temporary / "file/below"), HasSubstr("/file/below': Not a directory"));
    EXPECT_THAT(open_error(temporary / "broken"),
                HasSubstr("/broken' is a symbolic link to 'nowhere', which does not"));
    EXPECT_THAT(open_error(temporary / "broken/below"), HasSubstr("cannot create output folder"));
    EXPECT_THAT(open_error(temporary / "loop"), HasSubstr("Too many levels of symbolic links"));
    EXPECT_THAT(open_error(""), HasSubstr("empty"));
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("broken", "file", "loop"));
}

TEST(OutputFolder, FollowsALinkToAFolder) {
    const TemporaryFolder temporary;
    fs::create_directory(temporary / "scratch");
    fs::create_directory_symlink("scratch", temporary / "out");
    OutputFolder folder(temporary / "out");
    write_byte(folder, "frame_0000.png");
    EXPECT_THAT(names_in(temporary / "scratch"), ElementsAre("frame_0000.png"));
}

TEST(OutputFolder, RemovesWhatItCreatedWhenALaterStepFails) {
    const TemporaryFolder temporary;
    const std::string too_long(300, 'x');
    EXPECT_THAT(open_error(temporary / ("a/b/" + too_long)), HasSubstr("File name too long"));
    EXPECT_THAT(names_in(temporary.path()), IsEmpty());
}

// Root may write anywhere, so the check runs in a child without its rights.
TEST(OutputFolder, RefusesAFolderItMayNotWrite) {
    const TemporaryFolder temporary;
    const fs::path locked = temporary / "locked";
    fs::create_directory(locked);
    fs::permissions(temporary.path(), fs::perms(0755));
    fs::permissions(locked, fs::perms(0555));
    const auto denied_with = [](const fs::path& path, const std::string& text) {
        return wait_for(start_child([&] {
            if (geteuid() == 0 && (setegid(65534) != 0 || seteuid(65534) != 0)) return 2;
            return open_error(path).find(text) != std::string::npos ? 0 : 1;
        }));
    };
    EXPECT_EQ(denied_with(locked, "cannot write to output folder '" + locked.string() + "': Permission denied"), 0);
    EXPECT_EQ(denied_with(locked / "new/deep", "cannot create output folder '" + (locked / "new").string()), 0);
    EXPECT_THAT(names_in(locked), IsEmpty());
}

TEST(OutputFolder, KeepsASecondProcessOut) {
    const TemporaryFolder temporary;
    int ready[2], release[2];
    ASSERT_EQ(pipe(ready), 0);
    ASSERT_EQ(pipe(release), 0);
    const pid_t child = start_child([&] {
        OutputFolder folder(temporary / "out");
        char byte = 'r';
        if (write(ready[1], &byte, 1) != 1) return 1;
        close(release[1]);
        return static_cast<int>(read(release[0], &byte, 1));
    });
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    for (const auto existing : {ExistingFiles::refuse, ExistingFiles::overwrite, ExistingFiles::resume}) {
        EXPECT_THAT(open_error(temporary / "out", existing), HasSubstr("another drape is writing to output folder"));
    }
    ASSERT_EQ(write(release[1], &byte, 1), 1);
    ASSERT_EQ(wait_for(child), 1);
    EXPECT_EQ(open_error(temporary / "out"), "");
    for (const int end : {ready[0], ready[1], release[0], release[1]}) close(end);
}

// Fills a folder with a finished run (two frames, positions, a profile known from the manifest only) and with others'
// files.
void fill_with_a_run(const fs::path& path) {
    OutputFolder folder(path);
    Manifest manifest;
    for (const char* name :
         {"frame_0000.png", "frame_12345.png", "positions.npy", "positions_flag.npy", "profile.json"}) {
        write_byte(folder, name);
    }
    for (const char* name : {"profile.json", "../outside", "sub", ".."}) manifest.files.push_back({name, 1, ""});
    write_manifest(folder, manifest);
    for (const char* name :
         {"frame_0001.png.tmp-77", "notes.txt", "frame_1.png", "frame_0001.png.bak", "frame_000x.png", "positionsX.npy",
          "positions.npy.tmp-", "xframe_0001.png", "letter.tmp-12"}) {
        write_text(path / name, "x");
    }
    fs::create_directory(path / "frame_0002.png");
    fs::create_directory(path / "sub");
    write_text(path.parent_path() / "outside", "x");
    write_text(path.parent_path() / "linked", "precious");
    fs::create_symlink("../linked", path / "frame_0003.png");
}

TEST(OutputFolder, OverwriteRemovesOnlyOurFilesAndOnlyAtTheFirstWrite) {
    const TemporaryFolder temporary;
    fill_with_a_run(temporary / "out");
    const std::set<std::string> before = names_in(temporary / "out");
    OutputFolder folder(temporary / "out", ExistingFiles::overwrite);
    EXPECT_EQ(names_in(temporary / "out"), before);
    EXPECT_THAT(folder.files_to_remove(),
                ElementsAre("frame_0000.png", "frame_0001.png.tmp-77", "frame_0003.png", "frame_12345.png",
                            "manifest.json", "positions.npy", "positions_flag.npy", "profile.json"));
    write_byte(folder, "frame_0009.png");
    EXPECT_THAT(
        names_in(temporary / "out"),
        ElementsAre("frame_0001.png.bak", "frame_0002.png", "frame_0009.png", "frame_000x.png", "frame_1.png",
                    "letter.tmp-12", "notes.txt", "positions.npy.tmp-", "positionsX.npy", "sub", "xframe_0001.png"));
    EXPECT_TRUE(fs::exists(temporary / "outside"));
    EXPECT_EQ(read_text(temporary / "linked"), "precious");
}

TEST(OutputFolder, ResumeKeepsFramesButNotTheManifest) {
    const TemporaryFolder temporary;
    fill_with_a_run(temporary / "out");
    OutputFolder folder(temporary / "out", ExistingFiles::resume);
    EXPECT_THAT(folder.files_to_remove(), ElementsAre("frame_0001.png.tmp-77", "manifest.json"));
    EXPECT_TRUE(folder.has_file("frame_0000.png"));
    EXPECT_FALSE(folder.has_file("frame_0004.png"));
    folder.begin_writing();
    EXPECT_FALSE(folder.has_file("manifest.json"));
    EXPECT_TRUE(folder.has_file("frame_0000.png"));
}

TEST(OutputFolder, RefusesToReplaceAnotherProgramsManifest) {
    const TemporaryFolder temporary;
    const std::string deep(100000, '[');
    for (const std::string& text : {std::string("{\"name\": \"web app\", \"files\": []}"), std::string("[1, 2]"),
                                    std::string("{\"format\": \"drape manifest 1\""), std::string(), deep}) {
        write_text(temporary / "manifest.json", text);
        for (const auto existing : {ExistingFiles::overwrite, ExistingFiles::resume}) {
            EXPECT_THAT(open_error(temporary.path(), existing), HasSubstr("manifest.json' was not written by drape"));
        }
        EXPECT_EQ(read_text(temporary / "manifest.json"), text);
    }
}

TEST(OutputFolder, FileNamesCannotLeadOutOfTheFolder) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary / "out");
    for (const char* name : {"../escape.npy", "", "..", ".", "a/b"}) {
        EXPECT_THROW(write_byte(folder, name), OutputError) << name;
    }
    EXPECT_THAT(names_in(temporary / "out"), IsEmpty());
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("out"));
}

}  // namespace
}  // namespace drape
