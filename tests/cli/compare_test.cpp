// drape compare compares arrays, pictures and folders by their numbers. (Profiles: profile_test.cpp.)
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <sstream>

#include "output/npy.h"
#include "output/png.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;

void write_array(const fs::path& path, const std::vector<float>& values) {
    fs::create_directories(path.parent_path());
    write_text(path, npy_array("<f4", fmt::format("{}, 2", values.size() / 2), std::as_bytes(std::span(values))));
}

void write_picture(const fs::path& path, std::uint32_t width, std::vector<std::uint8_t> rgba) {
    fs::create_directories(path.parent_path());
    std::vector<std::uint8_t> png;
    encode_png(width, static_cast<std::uint32_t>(rgba.size() / 4 / width), rgba, png);
    write_text(path, std::string(png.begin(), png.end()));
}

class Compare : public testing::Test, public TemporaryFolder {
  protected:
    Outcome run(const std::string& a, const std::string& b, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"compare", (*this / a).string(), (*this / b).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return drape(arguments);
    }
};

TEST_F(Compare, ArraysByLargestAndRmsDifference) {
    write_array(*this / "a.npy", {1, 2, 3, 4});
    write_array(*this / "b.npy", {1, 2, 3.5, 4});
    EXPECT_EQ(run("a.npy", "a.npy").code, 0);
    const Outcome outcome = run("a.npy", "b.npy");
    EXPECT_EQ(outcome.code, 7);
    EXPECT_EQ(outcome.out,
              "OVER  a.npy: float32 (2, 2): largest difference 0.5 at (1, 0), RMS 0.25, 1 of 4 values differ\n"
              "1 compared, 1 over its limit\n");
    EXPECT_EQ(run("a.npy", "b.npy", {"--max", "0.5"}).code, 0);
    EXPECT_EQ(run("a.npy", "b.npy", {"--max", "0.49"}).code, 7);
    EXPECT_EQ(run("a.npy", "b.npy", {"--rms", "0.25"}).code, 0);
    EXPECT_EQ(run("a.npy", "b.npy", {"--max", "1", "--rms", "0.24"}).code, 7);
    write_array(*this / "c.npy", {1, 2});
    EXPECT_THAT(run("a.npy", "c.npy", {"--max", "9"}).out, HasSubstr("OVER  a.npy: float32 (2, 2) and float32 (1, 2)"));
}

TEST_F(Compare, WhatIsNoNumberIsNearNothingButItself) {
    write_array(*this / "a.npy", {NAN, INFINITY, 1, 2});
    write_array(*this / "b.npy", {1, INFINITY, 1, 2});
    EXPECT_EQ(run("a.npy", "a.npy").code, 0);
    const Outcome outcome = run("a.npy", "b.npy", {"--max", "1e30"});
    EXPECT_EQ(outcome.code, 7);
    EXPECT_THAT(outcome.out, HasSubstr("largest difference inf at (0, 0), RMS inf, 1 of 4 values differ"));
}

TEST_F(Compare, TwoDevicesAreComparedWithoutTheirNames) {
    const auto write = [&](const char* name, const std::string& parameters) {
        write_text(*this / "make.py", "import numpy as n\nn.savez('" + (*this / name).string() +
                                          "', positions=n.zeros((1, 2)), parameters=n.array('" + parameters + "'))\n");
        ASSERT_EQ(Running("/usr/bin/python3", {(*this / "make.py").string()}).wait().code, 0);
    };
    write("a.npz", R"({"device": "one", "driver": "d 1", "kernels": ["line"], "substeps": 4})");
    write("b.npz", R"({"device": "another", "driver": "e", "kernels": [], "substeps": 4})");
    write("c.npz", R"({"device": "one", "driver": "d 1", "kernels": ["line"], "substeps": 5})");
    const Outcome same = run("a.npz", "b.npz");
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_THAT(same.out, HasSubstr("ok    a.npz/parameters: equal but for the device and its kernels"));
    const Outcome other = run("a.npz", "c.npz");
    EXPECT_EQ(other.code, 7);
    EXPECT_THAT(other.out, HasSubstr("OVER  a.npz/parameters: other choices"));
}

TEST_F(Compare, NothingIsNoSuccess) {
    fs::create_directories(*this / "a/jobs");
    fs::create_directories(*this / "b");
    write_text(*this / "b/manifest.json", "{}");
    const Outcome outcome = run("a", "b");
    EXPECT_EQ(outcome.code, 7);
    EXPECT_THAT(outcome.err, HasSubstr("nothing to compare: neither folder has a file"));
    const Outcome json = run("a", "b", {"--json"});
    EXPECT_EQ(json.code, 7);
    EXPECT_EQ(json.out, "[]\n");
}

TEST_F(Compare, PicturesByTheirSignalToNoiseRatio) {
    const std::vector<std::uint8_t> black(4 * 6, 0);
    std::vector<std::uint8_t> spot = black;
    spot[4 * 4 + 1] = 51;  // green of column 1, row 1
    write_picture(*this / "a.png", 3, black);
    write_picture(*this / "b.png", 3, spot);
    // The mean square is 51^2 / 18: 20 lg(255 / 51) + 10 lg 18 = 26.53 dB.
    const Outcome outcome = run("a.png", "b.png");
    EXPECT_EQ(outcome.code, 7);
    EXPECT_THAT(outcome.out,
                HasSubstr("a.png: 3x2 pixels: PSNR 26.53 dB, largest difference 51 of 255 at column 1, row 1"));
    EXPECT_EQ(run("a.png", "a.png", {"--psnr", "99"}).code, 0);
    EXPECT_EQ(run("a.png", "b.png", {"--psnr", "26.5"}).code, 0);
    EXPECT_EQ(run("a.png", "b.png", {"--psnr", "26.6"}).code, 7);
    EXPECT_EQ(run("a.png", "b.png", {"--max-channel", "51"}).code, 0);
    EXPECT_EQ(run("a.png", "b.png", {"--max-channel", "50"}).code, 7);
}

TEST_F(Compare, FoldersFileByFile) {
    const SceneFolder scene(small_scene(3));
    const auto made = [&](const std::string& name, const std::string& gravity) {
        EXPECT_EQ(drape({"render", scene.scene(), "-o", (*this / name).string(), "-q", "--export", "npz,obj", "--set",
                         "/gravity=[0," + gravity + ",0]"})
                      .code,
                  0);
    };
    made("a", "-9.81"), made("b", "-9.81"), made("c", "-9");
    const Outcome same = run("a", "b");
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_THAT(same.out, AllOf(HasSubstr("ok    frame_0002.png: 64x48 pixels: equal\n"),
                                HasSubstr("ok    mesh_0001.obj: equal bytes\n"),
                                HasSubstr("ok    positions.npz/velocities: float32 (3, 6, 8, 3): equal\n"),
                                HasSubstr(" compared, 0 over their limit\n")));
    EXPECT_THAT(run("a", "c").out,
                AllOf(HasSubstr("OVER  positions.npz/positions: "), HasSubstr("ok    positions.npz/faces: "),
                      HasSubstr("OVER  positions.npz/scene: <U"), HasSubstr("OVER  mesh_0002.obj: other bytes\n")));
    fs::remove(*this / "b/frame_0001.png");
    const Outcome fewer = run("a", "b", {"--json"});
    EXPECT_EQ(fewer.code, 7);
    Json::Value rows;
    std::istringstream(fewer.out) >> rows;
    std::size_t over = 0;
    for (const Json::Value& row : rows) {
        if (!row["over"].asBool()) continue;
        ++over;
        EXPECT_EQ(row["name"].asString(), "frame_0001.png");
        EXPECT_EQ(row["text"].asString(), "only in " + (*this / "a").string());
    }
    EXPECT_EQ(over, 1u);
}

TEST_F(Compare, FoldersWithWhatIsInTheirFolders) {
    for (const char* side : {"a", "b"}) {
        for (const char* file : {"runs/0000/positions.npy", "runs/0001/deep/positions.npy"}) {
            fs::create_directories((*this / side / file).parent_path());
            write_array(*this / side / file, {1, 2, 3, 4});
        }
        fs::create_directories(*this / side / "jobs");
        for (const char* file : {"jobs/0000.json", "results.csv", "runs/0000/manifest.json"})
            write_text(*this / side / file, std::string("took another time in ") + side);
    }
    const Outcome same = run("a", "b");
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_THAT(same.out, HasSubstr("ok    runs/0001/deep/positions.npy: float32 (2, 2): equal\n2 compared, 0 over"));
    write_array(*this / "b/runs/0001/deep/positions.npy", {1, 2, 3, 5});
    write_text(*this / "b/runs/note.txt", "more");
    const Outcome other = run("a", "b");
    EXPECT_EQ(other.code, 7);
    EXPECT_THAT(other.out, AllOf(HasSubstr("OVER  runs/0001/deep/positions.npy: "),
                                 HasSubstr("OVER  runs/note.txt: only in " + (*this / "b").string())));
}

TEST_F(Compare, PositionsOfSensitiveFramesByTheirMeans) {
    // Two frames of two values each; in the second the runs differ by 1 and -0.5, so their means by 0.25.
    write_array(*this / "a/positions.npy", {1, 2, 3, 4});
    write_array(*this / "b/positions.npy", {1, 2.1f, 4, 3.5f});
    EXPECT_EQ(run("a", "b", {"--max", "0.2"}).code, 7);
    const auto manifest = [](const char* second) {
        return fmt::format(R"({{"statistics": [{{"frame": 0}}, {{"frame": 1{}}}]}})", second);
    };
    write_text(*this / "a/manifest.json", manifest(""));
    write_text(*this / "b/manifest.json", manifest(R"(, "sensitive": 1)"));
    const Outcome outcome = run("a/positions.npy", "b/positions.npy", {"--max", "0.2"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("largest difference 0.1 at (0, 1)"), HasSubstr("of the first 1 frames"),
                                   HasSubstr("means are at most 0.25 apart there")));
    EXPECT_EQ(run("a", "b", {"--max", "0.05"}).code, 7) << "frames before are judged";
    EXPECT_EQ(run("a", "b").code, 7) << "without a limit bytes are promised, and compared";
    write_text(*this / "b/manifest.json", "no JSON");
    EXPECT_EQ(run("a", "b", {"--max", "0.2"}).code, 7);
}

TEST_F(Compare, ReadsWhatNumPyWrites) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    write_text(*this / "make.py", R"(
import numpy as n
n.savez("a.npz", big=n.arange(6).reshape(1, 2, 3), one=n.float64(2), text=n.array("x"), flags=n.array([True, False]))
n.savez_compressed("b.npz", big=n.arange(6, dtype=n.uint16).reshape(1, 2, 3) + n.uint16(1), one=n.float64(2), text=n.array("y"),
                   flags=n.array([True, False]), more=n.zeros(0))
n.save("f.npy", n.asfortranarray(n.zeros((3, 2))))
)");
    ASSERT_EQ(std::system(("cd " + path().string() + " && /usr/bin/python3 make.py").c_str()), 0);
    EXPECT_EQ(run("a.npz", "a.npz").code, 0);
    const Outcome outcome = run("a.npz", "b.npz", {"--max", "1"});
    EXPECT_EQ(outcome.code, 7);
    EXPECT_EQ(outcome.out, fmt::format("ok    a.npz/big: int64 (1, 2, 3) and uint16 (1, 2, 3): largest difference 1 at "
                                       "(0, 0, 0), RMS 1, 6 of 6 values differ\n"
                                       "ok    a.npz/flags: bool (2): equal\n"
                                       "ok    a.npz/one: float64 (): equal\n"
                                       "OVER  a.npz/text: <U1 (): another text\n"
                                       "OVER  a.npz/more: only in {}\n"
                                       "5 compared, 2 over their limit\n",
                                       (*this / "b.npz").string()));
    const Outcome fortran = run("f.npy", "f.npy");
    EXPECT_EQ(fortran.code, 1);
    EXPECT_THAT(fortran.err, HasSubstr("f.npy': its values are in Fortran's order"));
}

TEST_F(Compare, SaysWhatItCannotRead) {
    write_text(*this / "a.npy", "no array");
    write_text(*this / "a.npz", "no archive");
    write_text(*this / "a.png", "no picture");
    write_text(*this / "cut.npy", npy_array("<f4", "3,", {}));
    for (const char* name : {"a.npy", "a.npz", "a.png", "cut.npy", "none.npy"}) {
        const Outcome outcome = run(name, name);
        EXPECT_EQ(outcome.code, 1) << name;
        EXPECT_THAT(outcome.err, HasSubstr(name));
    }
    EXPECT_EQ(run("a.npy", "a.png").code, 2);
    EXPECT_EQ(run(".", "a.png").code, 2);
    const Outcome absent = run(".", "absent");
    EXPECT_EQ(absent.code, 1);
    EXPECT_THAT(absent.err, HasSubstr("absent' does not exist"));
    EXPECT_EQ(run("a.npy", "a.npy", {"--max", "-1"}).code, 2);
}

/// Small files that say that they hold much: refused by what they say, before it is in memory.
TEST_F(Compare, RefusesWhatWouldExpandBeforeItDoes) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    write_text(*this / "make.py", R"(
import numpy as n, struct, zipfile, zlib
def npz(name, shape, zeros):
    with zipfile.ZipFile(name, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        header = "{'descr': '<f4', 'fortran_order': False, 'shape': (%s), }" % shape
        header += " " * (117 - len(header)) + "\n"
        archive.writestr("a.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", 118) + header.encode() + bytes(zeros))
npz("other.npz", "3,", 400_000_000)
npz("large.npz", "100000000,", 400_000_000)
def png(name, width, height, pixels):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                           chunk(b"IDAT", zlib.compress(bytes(pixels), 1)) + chunk(b"IEND", b""))
png("short.png", 16000, 16000, 1000)
png("large.png", 12000, 12000, 12000 * 36001)
)");
    ASSERT_EQ(std::system(("cd " + path().string() + " && /usr/bin/python3 make.py").c_str()), 0);
    const auto refused = [&](const char* name, const char* why, const std::string& limit) {
        const std::string file = (*this / name).string();
        const Outcome outcome =
            Running("/bin/sh", {"-c", limit + " exec " DRAPE_PROGRAM " compare " + file + " " + file}).wait();
        EXPECT_EQ(outcome.code, 1) << name;
        EXPECT_THAT(outcome.err, AllOf(HasSubstr(file), HasSubstr(why)));
        EXPECT_LT(outcome.peak_memory_kib, 100 << 10) << name;
    };
    refused("other.npz", "it has 400000000 bytes of values, not those of float32 (3)", "");
    refused("large.npz", " needs 400 MB, and ", "ulimit -v 400000;");
    refused("short.png", "16000x16000 pixels is not in ", "");
    refused("large.png", "12000x12000 pixels needs 432 MB, and ", "ulimit -v 400000;");
}

}  // namespace
}  // namespace drape
