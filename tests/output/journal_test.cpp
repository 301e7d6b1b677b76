#include "output/journal.h"

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace drape {
namespace {

constexpr std::uint64_t few = 1 << 20;  // bytes that may wait once there is a file

/// Returns a record of about 64 KiB.
JournalRecord record_of(std::uint32_t frame) {
    return {.frame = frame,
            .values = {{"a", frame * 0.5}},
            .positions = {std::vector<float>(16384, static_cast<float>(frame))}};
}

std::vector<std::uint32_t> frames_in(const Journal& journal, std::uint64_t length) {
    std::vector<std::uint32_t> frames;
    journal.read(length, [&](JournalRecord&& record) {
        EXPECT_EQ(encode_record(record), encode_record(record_of(record.frame)));
        frames.push_back(record.frame);
    });
    return frames;
}

class JournalTest : public testing::Test {
  protected:
    std::uint64_t on_disk() const { return std::filesystem::file_size(temporary_ / "out/journal.drape"); }
    void add(std::uint32_t first, std::uint32_t end) {
        for (; first < end; ++first) journal_.add(record_of(first));
    }

    TemporaryFolder temporary_;
    OutputFolder folder_{temporary_ / "out"};
    Journal journal_{folder_, "a key"};
};

TEST_F(JournalTest, ShortRunsNeverWriteIt) {
    add(0, 100);
    EXPECT_FALSE(std::filesystem::exists(temporary_ / "out/journal.drape"));
}

TEST_F(JournalTest, TooManyBytesDoNotWaitForACheckpoint) {
    add(0, 300);
    EXPECT_GT(on_disk(), 300 * 65536 - 2 * few);
}

TEST_F(JournalTest, OnceThereIsAFileFewBytesWait) {
    add(0, 100);
    const std::uint64_t first = journal_.sync(), record = first / 100;
    EXPECT_EQ(on_disk(), first);
    for (std::uint32_t frame = 100; frame < 300; ++frame) {
        add(frame, frame + 1);
        EXPECT_GE(on_disk() + few + record, first + (frame - 99) * record) << frame;
    }
    const std::uint64_t second = journal_.sync();
    EXPECT_EQ(on_disk(), second);
    EXPECT_EQ(frames_in(journal_, second).size(), 300u);
    EXPECT_EQ(frames_in(journal_, first).size(), 100u);
}

TEST_F(JournalTest, WhatFollowsTheCheckpointGoesWhenARunGoesOn) {
    add(0, 2);
    const std::uint64_t length = journal_.sync();
    add(2, 40);
    EXPECT_GT(on_disk(), length);  // written before any checkpoint that counts them
    Journal next(folder_, "a key");
    next.go_on_behind(length);
    EXPECT_EQ(on_disk(), length);
    next.add(record_of(7));
    EXPECT_EQ(frames_in(next, next.sync()), (std::vector<std::uint32_t>{0, 1, 7}));
}

}  // namespace
}  // namespace drape
