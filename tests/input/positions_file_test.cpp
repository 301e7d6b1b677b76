#include "input/positions_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>

#include "../support/given_files.h"
#include "base/output_error.h"
#include "output/zip_file.h"

namespace drape::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Positions = std::vector<std::array<double, 3>>;

const std::vector<float> six{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17.5f};

class PositionsFile : public ::testing::Test {
  protected:
    Positions read(const std::string& name) const { return input::read_positions(folder_ / name, 3, 2); }
    Positions written(const std::string& name, const std::string& bytes) const {
        write_text(folder_ / name, bytes);
        return read(name);
    }
    std::string error(const std::string& name, const std::string& bytes) const {
        return error_text<OutputError>([&] { written(name, bytes); });
    }
    static void expect_six(const Positions& positions) {
        ASSERT_EQ(positions.size(), 6u);
        for (std::size_t i = 0; i < 18; ++i) EXPECT_EQ(positions[i / 3][i % 3], double{six[i]}) << i;
    }
    std::string archive(const std::string& part, const std::string& bytes) const {
        OutputFolder folder((folder_ / "zip").string(), ExistingFiles::overwrite);
        ZipFile zip(folder, "positions.npz", false);
        zip.add(part, bytes);
        zip.commit();
        return read_text(folder_ / "zip/positions.npz");
    }
    static std::string cache(std::int32_t points, std::int32_t samples, const std::vector<float>& values) {
        std::string bytes("POINTCACHE2\0", 12);
        const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
        put(std::int32_t{1});
        put(points);
        put(0.0f);
        put(1.0f);
        put(samples);
        for (const float value : values) put(value);
        return bytes;
    }

    TemporaryFolder folder_;
};

TEST_F(PositionsFile, ArraysOfBothPrecisions) {
    expect_six(written("a.npy", npy_of("<f4", "2, 3, 3", six)));
    expect_six(written("b.NPY", npy_of("<f8", "2, 3, 3", std::vector<double>(six.begin(), six.end()))));
}

TEST_F(PositionsFile, TheLastFrameOfSeveralCounts) {
    std::vector<float> frames(36, -1.0f);
    frames.insert(frames.end(), six.begin(), six.end());
    expect_six(written("a.npy", npy_of("<f4", "3, 2, 3, 3", frames)));
    expect_six(written("a.npz", archive("positions.npy", npy_of("<f4", "3, 2, 3, 3", frames))));
    expect_six(written("a.pc2", cache(6, 3, frames)));
}

TEST_F(PositionsFile, VerticesOfAMesh) {
    expect_six(written("a.obj",
                       "# a comment\nv 0 1 2\r\nv\t3 4 5 1.0\nvt 0 0\nv 6 7 8\nvn 0 0 1\nv 9 10 11\nv 12 13 14\n"
                       "f 1 2 3\nv 15 16 1.75e1"));
    EXPECT_THAT(error("a.obj", "v 0 1 2\nv 3 x 5\n"), HasSubstr("a.obj': line 2 is no vertex"));
    EXPECT_THAT(error("a.obj", "v 0 1 2\nv 3 4\n"), HasSubstr("line 2 is no vertex"));
    EXPECT_THAT(error("a.obj", "v 0 1 2\nv 3 4 5\n"), HasSubstr("3 x 2 particles needs 6 vertices, and it has 2"));
    EXPECT_THAT(error("a.obj", std::string(3 << 20, 'v')), HasSubstr("line 1 is too long"));
}

TEST_F(PositionsFile, ParticlesInHolesMayBeMissing) {
    const std::vector<bool> is_used{true, true, true, true, false, false};
    write_text(folder_ / "a.obj", "v 0 1 2\nv 3 4 5\nv 6 7 8\nv 9 10 11\n");
    write_text(folder_ / "a.pc2", cache(4, 1, {six.begin(), six.begin() + 12}));
    const Positions expected{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {6, 7, 8}, {6, 7, 8}};
    for (const char* name : {"a.obj", "a.pc2"})
        EXPECT_EQ(input::read_positions(folder_ / name, 3, 2, is_used), expected) << name;
    write_text(folder_ / "b.pc2", cache(6, 1, six));
    expect_six(input::read_positions(folder_ / "b.pc2", 3, 2, is_used));
    write_text(folder_ / "c.obj", "v 0 1 2\nv 3 4 5\nv 6 7 8\nv 9 10 11\nv 0 0 0\n");
    EXPECT_THAT(error_text<OutputError>([&] { input::read_positions(folder_ / "c.obj", 3, 2, is_used); }),
                HasSubstr("needs 6 vertices, or 4 without those in holes, and it has 5"));
}

TEST_F(PositionsFile, AMeshOfMillionsOfVerticesIsCountedAndNotKept) {
    std::string text;
    for (int i = 0; i < 1'000'000; ++i) text += "v 1 2 3\n";
    EXPECT_THAT(error("a.obj", text), HasSubstr("needs 6 vertices, and it has 1000000"));
}

TEST_F(PositionsFile, AnotherShapeIsSaidBesideTheOneThatIsNeeded) {
    EXPECT_THAT(error("a.npy", npy_of("<f4", "3, 2, 3", six)),
                AllOf(HasSubstr("a.npy"), HasSubstr("(2, 3, 3) or (frames, 2, 3, 3)"), HasSubstr("float32 (3, 2, 3)")));
    EXPECT_THAT(error("a.npy", npy_of("<i4", "2, 3, 3", std::vector<std::int32_t>(18))), HasSubstr("int32 (2, 3, 3)"));
    EXPECT_THAT(error("a.npy", npy_of("<f4", "0, 2, 3, 3", std::vector<float>{})), HasSubstr("float32 (0, 2, 3, 3)"));
    EXPECT_THAT(error("a.pc2", cache(5, 1, six)), HasSubstr("needs 6 points, and it has 5"));
}

TEST_F(PositionsFile, DamageIsSaid) {
    const std::string whole = npy_of("<f4", "2, 3, 3", six);
    EXPECT_THAT(error("a.npy", whole.substr(0, whole.size() - 1)), HasSubstr("it has 71 bytes of values"));
    EXPECT_THAT(error("a.npy", whole.substr(0, 40)), HasSubstr("it ends within its header"));
    EXPECT_THAT(error("a.npy", "no array"), HasSubstr("it is no NumPy array"));
    EXPECT_THAT(error("a.npy", ""), HasSubstr("it is no NumPy array"));
    const std::string zip = archive("positions.npy", whole);
    EXPECT_THAT(error("a.npz", zip.substr(0, zip.size() / 2)), HasSubstr("a.npz"));
    EXPECT_THAT(error("a.npz", whole), HasSubstr("a.npz"));
    EXPECT_THAT(error("a.npz", archive("velocities.npy", whole)), HasSubstr("it has no array \"positions\""));
    EXPECT_THAT(error("a.pc2", cache(6, 2, six)), HasSubstr("it ends too early"));
    EXPECT_THAT(error("a.pc2", cache(6, 0, six)), HasSubstr("no point cache (PC2) with a sample"));
}

TEST_F(PositionsFile, AHeaderThatAsksForMoreThanThereIsTakesNoMemory) {
    std::string huge = npy_header("<f4", "1000000000, 2, 3, 3");
    EXPECT_THAT(error("a.npy", huge), HasSubstr("it has 0 bytes of values"));
    std::string text(70000, 'x');
    text.replace(0, 12, std::string("\x93NUMPY\x02\x00\xff\xff\xff\x7f", 12));
    EXPECT_THAT(error("a.npy", text), HasSubstr("it ends within its header"));
}

TEST_F(PositionsFile, OnlyFilesAreOpened) {
    EXPECT_THAT(error_text<OutputError>([&] { read("none.npy"); }), HasSubstr("none.npy': No such file"));
    std::filesystem::create_directory(folder_ / "folder.npy");
    EXPECT_THAT(error_text<OutputError>([&] { read("folder.npy"); }), HasSubstr("it is no file"));
    for (const char* pipe : {"pipe.npy", "pipe.npz", "pipe.obj"}) {  // nobody writes to it: to open it would wait
        ASSERT_EQ(mkfifo((folder_ / pipe).c_str(), 0600), 0);
        EXPECT_THAT(error_text<OutputError>([&] { read(pipe); }), HasSubstr("it is no file"));
    }
    EXPECT_THAT(error("a.txt", "0 1 2"), HasSubstr("positions are read from .npy, .npz, .obj and .pc2"));
}

}  // namespace
}  // namespace drape::testing
