#include "output/frame_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <random>
#include <utility>

#include "temporary_folder.h"

namespace drape {
namespace {

using Rows = std::map<std::uint32_t, FrameValues>;

Rows rows_of(const FrameTable& table) {
    Rows rows;
    std::int64_t before = -1;
    table.for_each([&](std::uint32_t frame, const FrameValues& values) {
        EXPECT_GT(frame, before);
        before = frame;
        rows[frame] = values;
    });
    return rows;
}

TEST(FrameTable, KeepsFramesOfAnyOrderAndTheLaterOfTwo) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary / "out");
    FrameTable table(folder);
    EXPECT_TRUE(rows_of(table).empty());
    table.add(7, {{"b", 1}});
    table.add(3, {{"a", 2}, {"b", 3}, {"c", NAN}});
    table.add(9, {});
    table.add(7, {{"a", -0.0}, {"d", 5}});
    const Rows expected{{3, {{"a", 2}, {"b", 3}}}, {7, {{"a", -0.0}, {"d", 5}}}, {9, {}}};
    EXPECT_EQ(rows_of(table), expected);
    EXPECT_THAT(table.frames(), testing::ElementsAre(7, 3, 9, 7));
    EXPECT_THAT(table.names(), testing::ElementsAre("a", "b", "c", "d"));
    EXPECT_THAT(table.column("b"), testing::ElementsAre(1, 3, testing::IsNan(), testing::IsNan()));
    EXPECT_THAT(table.column("none"), testing::Each(testing::IsNan()));
    EXPECT_TRUE(names_in(temporary / "out").empty());
}

// Rows have unlike lengths, so that some lie across the ends of what is read at once.
TEST(FrameTable, ManyFramesAreThoseThatWereAdded) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary / "out");
    FrameTable table(folder);
    std::mt19937 random(5);
    Rows expected;
    std::vector<double> column;
    for (std::uint32_t k = 0; k < 30000; ++k) {
        const std::uint32_t frame = k ^ 1u;
        FrameValues values;
        for (std::uint32_t name = 0; name < 24; ++name)
            if (random() % 3 > 0) values["number " + std::to_string(name)] = std::ldexp(random(), -20);
        table.add(frame, values);
        column.push_back(values.contains("number 4") ? values["number 4"] : -1);
        expected[frame] = std::move(values);
    }
    EXPECT_EQ(rows_of(table), expected);
    std::vector<double> found = table.column("number 4");
    for (double& value : found) value = std::isnan(value) ? -1 : value;
    EXPECT_EQ(found, column);
    EXPECT_TRUE(names_in(temporary / "out").empty()) << "what waits has no name";
}

TEST(FrameTable, AFullFileIsToldOfByTheManifestsName) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary / "out");
    FrameTable table(folder);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit little{1 << 16, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    const std::string text = error_text<OutputError>([&] {
        for (std::uint32_t frame = 0; frame < 200000; ++frame) table.add(frame, {{"a", 1}});
    });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_THAT(text, testing::HasSubstr("out/manifest.json"));
    EXPECT_THAT(text, testing::HasSubstr("too large"));
    const Rows rows = rows_of(table);  // rows added until the failure
    EXPECT_GT(rows.size(), 50000u);
    EXPECT_EQ(rows.rbegin()->first + 1, rows.size());
}

}  // namespace
}  // namespace drape
