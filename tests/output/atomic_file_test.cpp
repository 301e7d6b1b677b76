#include "output/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "temporary_folder.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    AtomicFile file(folder, "manifest.json");
    file.append(bytes_of("hello "));
    file.append(bytes_of("world"));
    EXPECT_THAT(names_in(temporary.path()), ElementsAre(StartsWith("manifest.json.tmp-")));
    const FileRecord record = file.commit();
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("manifest.json"));
    EXPECT_EQ(read_text(temporary / "manifest.json"), "hello world");
    // The hash is the one that `xxhsum -H2` prints for this text.
    EXPECT_EQ(record, (FileRecord{"manifest.json", 11, xxh3_128_hex("hello world")}));
    EXPECT_EQ(record.hash, "df8d09e93f874900a99b8775cc15b6c7");
}

TEST(AtomicFile, LeavesNothingWhenAbandoned) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    {
        AtomicFile file(folder, "manifest.json");
        file.append(bytes_of("half"));
    }
    EXPECT_THAT(names_in(temporary.path()), IsEmpty());
}

TEST(AtomicFile, HashesWhatLiesInTheFileAfterARewrite) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    const std::string body(3 << 20, 'b');
    AtomicFile file(folder, "positions.npy");
    file.append(bytes_of("head"));
    file.append(bytes_of(body));
    file.rewrite(1, bytes_of("EA"));
    EXPECT_THROW(file.rewrite(file.size() - 1, bytes_of("xx")), OutputError);
    EXPECT_THROW(file.rewrite(file.size() + 1, {}), OutputError);
    EXPECT_EQ(file.commit().hash, xxh3_128_hex("hEAd" + body));
    EXPECT_EQ(read_text(temporary / "positions.npy"), "hEAd" + body);
}

TEST(AtomicFile, ReplacesALinkInsteadOfWritingThroughIt) {
    const TemporaryFolder temporary;
    write_text(temporary / "victim", "precious");
    OutputFolder folder(temporary / "out");
    std::filesystem::create_symlink("../victim", temporary / "out/frame_0000.png");
    std::filesystem::create_symlink("../victim", temporary / ("out/other.tmp-" + std::to_string(getpid())));
    write_file(folder, "frame_0000.png", bytes_of("ours"));
    EXPECT_THROW(write_file(folder, "other", bytes_of("ours")), OutputError);
    EXPECT_EQ(read_text(temporary / "victim"), "precious");
    EXPECT_EQ(read_text(temporary / "out/frame_0000.png"), "ours");
}

TEST(AtomicFile, NamesPathAndReasonWhenAFolderIsInTheWay) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    std::filesystem::create_directory(temporary / "frame_0000.png");
    EXPECT_THAT(error_text<OutputError>([&] { write_file(folder, "frame_0000.png", bytes_of("x")); }),
                AllOf(HasSubstr("frame_0000.png'"), HasSubstr("Is a directory")));
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("frame_0000.png"));
}

// The signal that comes with the limit must not kill the program either.
TEST(AtomicFile, ReportsAFileSizeLimitAndKeepsEarlierFiles) {
    const TemporaryFolder temporary;
    const pid_t child = start_child([&] {
        signal(SIGXFSZ, SIG_DFL);
        OutputFolder folder(temporary.path());
        const rlimit limit{65536, 65536};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
        write_file(folder, "frame_0000.png", bytes_of(std::string(65536, 'x')));
        const std::string text =
            error_text<OutputError>([&] { write_file(folder, "frame_0001.png", bytes_of(std::string(65537, 'x'))); });
        const std::string expected = "cannot write '" + folder.path_of("frame_0001.png") + "': File too large";
        return text == expected ? 0 : 1;
    });
    EXPECT_EQ(wait_for(child), 0);
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("frame_0000.png"));
    EXPECT_EQ(std::filesystem::file_size(temporary / "frame_0000.png"), 65536u);
}

// Every file under its own name is whole, whenever the writer is killed.
TEST(AtomicFile, NoFileIsTornWhenTheWriterIsKilled) {
    std::mt19937 random(7);
    const std::string content(256 << 10, 'c');
    size_t finished_count = 0, temporary_count = 0;
    for (int round = 0; round < 20; ++round) {
        const TemporaryFolder temporary;
        const pid_t child = start_child([&] {
            OutputFolder folder(temporary / "out");
            for (int file = 0;; ++file)
                write_file(folder, "frame_" + std::to_string(1000 + file) + ".png", bytes_of(content));
            return 0;
        });
        while (!std::filesystem::exists(temporary / "out/frame_1000.png")) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
        kill(child, SIGKILL);
        EXPECT_EQ(wait_for(child), 128 + SIGKILL);
        for (const std::string& name : names_in(temporary / "out")) {
            if (is_temporary_file_name(name)) {
                ++temporary_count;
            } else {
                ++finished_count;
                EXPECT_EQ(read_text(temporary / ("out/" + name)), content) << name;
            }
        }
        // The next run clears the dead one's temporary away.
        OutputFolder(temporary / "out", ExistingFiles::resume).begin_writing();
        for (const std::string& name : names_in(temporary / "out")) EXPECT_FALSE(is_temporary_file_name(name));
    }
    EXPECT_GE(finished_count, 20u);
    EXPECT_GT(temporary_count, 0u) << "no round hit a file being written, so the test showed nothing";
}

TEST(AtomicFile, PipesAreWrittenToAndLinksStayLinks) {
    const TemporaryFolder temporary;
    const std::filesystem::path pipe = temporary / "pipe", link = temporary / "link", target = temporary / "target";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0666), 0);
    const FileDescriptor reader(open(pipe.c_str(), O_RDWR | O_CLOEXEC));
    write_file(pipe, "report");
    std::array<char, 7> got{};
    ASSERT_EQ(read(reader.get(), got.data(), got.size()), 6);
    EXPECT_STREQ(got.data(), "report");
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    std::filesystem::create_symlink("target", link);
    for (const char* text : {"first", "second"}) {
        write_file(link, text);
        EXPECT_TRUE(std::filesystem::is_symlink(link));
        EXPECT_EQ(read_text(target), text);
    }
    EXPECT_THROW(write_file(temporary.path(), "of a folder"), OutputError);
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("link", "pipe", "target"));
}

}  // namespace
}  // namespace drape
