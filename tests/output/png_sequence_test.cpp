#include "output/png_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <random>

#include "output/png.h"
#include "temporary_folder.h"

namespace drape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint32_t frame_width = 96, frame_height = 64;

void fill(std::vector<std::uint8_t>& rgba, std::uint64_t frame) {
    std::mt19937 random(static_cast<unsigned>(frame));
    for (auto& byte : rgba) byte = static_cast<std::uint8_t>(random());
}

void submit_frames(PngSequence& sequence, std::uint64_t count) {
    for (std::uint64_t frame = 0; frame < count; ++frame) {
        std::vector<std::uint8_t> rgba = sequence.take_buffer(frame_width * frame_height * 4);
        fill(rgba, frame);
        sequence.submit(frame, frame_width, frame_height, std::move(rgba));
    }
}

TEST(PngSequence, NamesFramesWithEnoughDigits) {
    EXPECT_EQ(frame_digits(0), 4);
    EXPECT_EQ(frame_digits(9999), 4);
    EXPECT_EQ(frame_digits(10000), 5);
    EXPECT_EQ(frame_file_name(1, 4), "frame_0001.png");
    EXPECT_EQ(frame_file_name(123, 5), "frame_00123.png");
    EXPECT_TRUE(is_output_file_name(frame_file_name(123456, frame_digits(123456))));
}

TEST(PngSequence, WritesEveryFrameUnderItsNumber) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    PngSequence sequence(folder, 4, 3);
    submit_frames(sequence, 40);
    const std::vector<FileRecord> records = sequence.finish();
    ASSERT_EQ(records.size(), 40u);
    for (std::uint64_t frame = 0; frame < 40; ++frame) {
        const FileRecord& record = records[frame];
        EXPECT_EQ(record.name, frame_file_name(frame, 4));
        const std::string file = read_text(temporary / record.name);
        EXPECT_EQ(record.bytes, file.size());
        EXPECT_EQ(record.hash, xxh3_128_hex(file));
        std::vector<std::uint8_t> rgba(frame_width * frame_height * 4), png;
        fill(rgba, frame);
        encode_png(frame_width, frame_height, rgba, png);
        EXPECT_EQ(file, std::string(png.begin(), png.end())) << frame;
    }
    EXPECT_EQ(names_in(temporary.path()).size(), 40u);
}

TEST(PngSequence, TheNumberOfWorkersChangesNoByte) {
    std::vector<std::vector<FileRecord>> results;
    for (const unsigned worker_count : {0u, 1u, 2u, 5u}) {
        const TemporaryFolder temporary;
        OutputFolder folder(temporary.path());
        PngSequence sequence(folder, 4, worker_count);
        submit_frames(sequence, 12);
        results.push_back(sequence.finish());
    }
    for (const auto& result : results) EXPECT_EQ(result, results.front());
}

TEST(PngSequence, BuffersAreReused) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    PngSequence sequence(folder, 4, 1);
    std::set<const std::uint8_t*> buffers;
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
        std::vector<std::uint8_t> rgba = sequence.take_buffer(frame_width * frame_height * 4);
        // At most two frames are pending, so from the fourth on a written one's buffer comes back, with its content.
        EXPECT_EQ(rgba[0], frame < 3 ? rgba[0] : 7) << frame;
        rgba[0] = 7;
        buffers.insert(rgba.data());
        sequence.submit(frame, frame_width, frame_height, std::move(rgba));
    }
    sequence.finish();
    EXPECT_LE(buffers.size(), 3u);  // two pending, one in the caller's hands
}

TEST(PngSequence, CarriesAWorkersErrorToTheCaller) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    std::filesystem::create_directory(temporary / "frame_0002.png");
    PngSequence sequence(folder, 4, 2);
    const std::string expected = "cannot write '" + folder.path_of("frame_0002.png") + "': Is a directory";
    // The error arrives at some later submit, at the latest when the bounded queue is full.
    EXPECT_EQ(error_text<OutputError>([&] { submit_frames(sequence, 1000); }), expected);
    EXPECT_EQ(error_text<OutputError>([&] { sequence.finish(); }), expected);
    EXPECT_LT(names_in(temporary.path()).size(), 20u);
}

TEST(PngSequence, FinishThrowsTheLastFramesError) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    std::filesystem::create_directory(temporary / "frame_0001.png");
    PngSequence sequence(folder, 4, 1);
    submit_frames(sequence, 2);
    EXPECT_THROW(sequence.finish(), OutputError);
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("frame_0000.png", "frame_0001.png"));
}

TEST(PngSequence, AFullDiskKeepsTheEarlierFrames) {
    const TemporaryFolder temporary;
    const pid_t child = start_child([&] {
        signal(SIGXFSZ, SIG_DFL);
        OutputFolder folder(temporary.path());
        const rlimit limit{4096, 4096};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
        PngSequence sequence(folder, 4, 2);
        sequence.submit(0, 8, 8, std::vector<std::uint8_t>(8 * 8 * 4));
        const std::string text = error_text<OutputError>([&] {
            std::vector<std::uint8_t> noise(frame_width * frame_height * 4);
            fill(noise, 1);
            sequence.submit(1, frame_width, frame_height, noise);
            sequence.finish();
        });
        return text.find("frame_0001.png': File too large") != std::string::npos ? 0 : 1;
    });
    EXPECT_EQ(wait_for(child), 0);
    EXPECT_THAT(names_in(temporary.path()), ElementsAre("frame_0000.png"));
}

TEST(PngSequence, RefusesFramesThatDoNotFit) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    PngSequence sequence(folder, 4, 1);
    EXPECT_THROW(sequence.submit(0, 4, 4, std::vector<std::uint8_t>(63)), std::invalid_argument);
    EXPECT_THROW(sequence.submit(0, 0, 0, {}), std::invalid_argument);
    EXPECT_TRUE(sequence.finish().empty());
    EXPECT_THROW(sequence.submit(0, 1, 1, std::vector<std::uint8_t>(4)), std::logic_error);
}

TEST(PngSequence, EndsWithoutFinish) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    {
        PngSequence sequence(folder, 4, 2);
        submit_frames(sequence, 5);
    }
    for (const std::string& name : names_in(temporary.path())) EXPECT_FALSE(is_temporary_file_name(name)) << name;
}

}  // namespace
}  // namespace drape
