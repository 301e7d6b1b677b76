#include "output/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "temporary_folder.h"

namespace drape {
namespace {

using testing::IsEmpty;
using testing::StartsWith;

std::vector<float> counting(size_t count, float first) {
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), first);
    return values;
}

void write_two_frames(OutputFolder& folder, std::uint64_t announced) {
    NpyWriter writer(folder, "positions.npy", announced, 2, 5);
    writer.append_frame(counting(30, 0));
    writer.append_frame(counting(30, 30));
    writer.finish();
}

constexpr std::string_view dictionary = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 5, 3), }";

TEST(Npy, FollowsTheFormat) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write_two_frames(folder, 2);
    const std::string file = read_text(temporary / "positions.npy");
    ASSERT_EQ(file.size(), 128u + 60 * 4);
    EXPECT_EQ(file.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));  // 128 - 10 = 0x76
    EXPECT_EQ(file.substr(10, dictionary.size()), dictionary);
    EXPECT_EQ(file[127], '\n');
    std::vector<float> values(60);
    std::memcpy(values.data(), file.data() + 128, 240);
    EXPECT_EQ(values, counting(60, 0));
}

// NumPy itself reads the file, where it is installed.
TEST(Npy, NumpyReadsIt) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write_two_frames(folder, 2);
    const std::string script =
        "/usr/bin/python3 -c \"import numpy as n, sys; a = n.load(sys.argv[1], mmap_mode='r'); "
        "assert a.shape == (2, 2, 5, 3) and a.dtype == n.dtype('<f4') and a.flags.c_contiguous, (a.shape, "
        "a.dtype); "
        "assert a.offset % 64 == 0; assert (a.ravel() == n.arange(60)).all(); "
        "assert a[1, 0, 2, 1] == 37\" ";
    EXPECT_EQ(std::system((script + (temporary / "positions.npy").string()).c_str()), 0);
}

TEST(Npy, CorrectsTheFrameCount) {
    const TemporaryFolder temporary;
    for (const std::uint64_t announced : {0ull, 1ull, 240ull, 1'000'000'000'000ull}) {
        OutputFolder folder(temporary / std::to_string(announced));
        write_two_frames(folder, announced);
        const std::string file = read_text(folder.path_of("positions.npy"));
        EXPECT_EQ(file.size(), 368u);
        EXPECT_THAT(file.substr(10), StartsWith(std::string(dictionary) + " "));
    }
}

TEST(Npy, RecordsTheHashOfTheFile) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    NpyWriter writer(folder, "positions.npy", 3, 1, 1);
    writer.append_frame(counting(3, 1));
    const FileRecord record = writer.finish();
    EXPECT_EQ(record.hash, xxh3_128_hex(read_text(temporary / "positions.npy")));
    EXPECT_EQ(record.bytes, 140u);
}

TEST(Npy, DropsTheFourthComponent) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    NpyWriter writer(folder, "positions.npy", 1, 1, 2);
    writer.append_frame_xyzw(std::vector<float>{1, 2, 3, -9, 4, 5, 6, -9});
    writer.finish();
    std::vector<float> values(6);
    std::memcpy(values.data(), read_text(temporary / "positions.npy").data() + 128, 24);
    EXPECT_EQ(values, counting(6, 1));
}

TEST(Npy, LeavesNothingWhenUnfinished) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    {
        NpyWriter writer(folder, "positions.npy", 2, 2, 5);
        writer.append_frame(counting(30, 0));
        EXPECT_THROW(writer.append_frame(counting(29, 0)), std::invalid_argument);
        EXPECT_THROW(writer.append_frame_xyzw(counting(30, 0)), std::invalid_argument);
        EXPECT_EQ(writer.frame_count(), 1u);
    }
    EXPECT_THAT(names_in(temporary.path()), IsEmpty());
}

TEST(Npy, RefusesSizesNoFileCanHave) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    constexpr auto most = std::numeric_limits<std::uint32_t>::max();
    EXPECT_THROW(NpyWriter(folder, "positions.npy", 1, 0, 5), std::invalid_argument);
    EXPECT_THROW(NpyWriter(folder, "positions.npy", 1, 5, 0), std::invalid_argument);
    EXPECT_THROW(NpyWriter(folder, "positions.npy", 1, most, most), std::invalid_argument);
    EXPECT_THROW(NpyWriter(folder, "positions.npy", std::numeric_limits<std::uint64_t>::max(), 2, 5),
                 std::invalid_argument);
    EXPECT_THAT(names_in(temporary.path()), IsEmpty());
}

}  // namespace
}  // namespace drape
