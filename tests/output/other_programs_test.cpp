// The programs that output formats are made for read their files. Those that are not installed are skipped;
// tools/check_exports has the large ones.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "temporary_folder.h"
#include "written_runs.h"

namespace drape {
namespace {

/// Returns whether the shell command succeeds.
bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

void expect_python(const TemporaryFolder& folder, const std::string& text) {
    write_text(folder / "check.py", text);
    EXPECT_EQ(std::system(fmt::format("cd {} && /usr/bin/python3 check.py", folder.path().string()).c_str()), 0);
}

/// Returns a format's stream of pictures of one colour each.
std::string stream(const char* format, std::uint32_t width, std::uint32_t height,
                   const std::vector<std::array<std::uint8_t, 3>>& colors) {
    WrittenRun run;
    run.width = width, run.height = height, run.fps = 30000.0 / 1001, run.step = 2;
    std::string bytes;
    const auto writer = find_output_format(format)->stream(
        [&bytes](std::span<const std::byte> part) {
            bytes.append(reinterpret_cast<const char*>(part.data()), part.size());
        },
        run);
    std::uint32_t number = 0;
    for (const auto& color : colors) {
        std::vector<std::uint8_t> rgba;
        for (std::uint32_t i = 0; i < width * height; ++i) {
            rgba.insert(rgba.end(), color.begin(), color.end());
            rgba.push_back(255);
        }
        WrittenFrame frame;
        frame.number = number++;
        frame.rgba = rgba;
        writer->add(frame);
    }
    EXPECT_THAT(writer->finish(), testing::IsEmpty());
    return bytes;
}

// The values are those of ITU-R BT.709-6, table 3.
TEST(Y4m, HasEvenSizesAndTheColorsOfTheStandard) {
    const std::string bytes = stream("y4m", 3, 1, {{255, 255, 255}, {0, 0, 0}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}});
    const std::string header = "YUV4MPEG2 W4 H2 F15000:1001 Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n";
    ASSERT_EQ(bytes.substr(0, bytes.find('\n') + 1), header);
    std::string expected = header;
    const int colors[][3] = {{235, 128, 128}, {16, 128, 128}, {63, 102, 240}, {173, 42, 26}, {32, 240, 118}};
    for (const auto& [y, cb, cr] : colors)
        expected += "FRAME\n" + std::string(8, static_cast<char>(y)) + std::string(2, static_cast<char>(cb)) +
                    std::string(2, static_cast<char>(cr));
    EXPECT_EQ(bytes, expected);
}

TEST(Rgb, IsThePixels) {
    EXPECT_EQ(stream("rgb", 2, 1, {{1, 2, 3}, {4, 5, 6}}), "\1\2\3\1\2\3\4\5\6\4\5\6");
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write("rgb", folder);
    const std::string bytes = read_text(temporary / "video.rgb");
    ASSERT_EQ(bytes.size(), 3u * 8 * 3);
    for (std::uint32_t frame = 0; frame < 3; ++frame)
        for (std::size_t i = 0; i < 24; ++i)
            EXPECT_EQ(static_cast<std::uint8_t>(bytes[frame * 24 + i]), picture_of(10 + 2 * frame)[i / 3 * 4 + i % 3]);
}

TEST(Y4m, FfmpegDecodesIt) {
    if (!runs("ffmpeg -version")) GTEST_SKIP() << "no ffmpeg";
    const TemporaryFolder temporary;
    const std::vector<std::array<std::uint8_t, 3>> colors{{200, 30, 60}, {10, 120, 250}, {128, 128, 128}};
    write_text(temporary / "video.y4m", stream("y4m", 5, 3, colors));
    ASSERT_TRUE(
        runs(fmt::format("ffmpeg -i {0}/video.y4m -vf scale=in_color_matrix=bt709 -f rawvideo -pix_fmt rgb24 "
                         "{0}/decoded.rgb",
                         temporary.path().string())));
    const std::string decoded = read_text(temporary / "decoded.rgb");
    ASSERT_EQ(decoded.size(), 3u * 6 * 4 * 3);
    for (std::size_t i = 0; i < decoded.size(); ++i)
        EXPECT_NEAR(static_cast<std::uint8_t>(decoded[i]), colors[i / 72][i % 3], 2) << i;
}

TEST(Vtu, MeshioReadsIt) {
    if (!runs("/usr/bin/python3 -c 'import meshio'")) GTEST_SKIP() << "no meshio";
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    for (const char* format : {"vtu", "obj", "ply", "npz"}) write(format, folder);
    expect_python(temporary, R"(
import meshio, numpy as n, xml.etree.ElementTree as xml
for name in ("flag", "rag"):
    run = n.load("positions_%s.npz" % name)
    for k, frame in enumerate((10, 12, 14)):
        faces = run["faces_0012"] if name == "flag" and frame >= 12 else run["faces"]
        for format in ("vtu", "obj", "ply"):
            mesh = meshio.read("mesh_%s_%04d.%s" % (name, frame, format))
            assert (n.float32(mesh.points) == run["positions"][k].reshape(-1, 3)).all(), (format, name, frame)
            assert (mesh.cells_dict["triangle"] == faces).all(), (format, name, frame)
        mesh = meshio.read("mesh_%s_%04d.vtu" % (name, frame))
        assert (mesh.point_data["velocity"] == run["velocities"][k].reshape(-1, 3)).all()
        assert (mesh.point_data["contact"].ravel() == run["contacts"][k].ravel()).all()
        assert (mesh.point_data["uv"] == run["uv"].reshape(-1, 2)).all()
sets = [s.attrib for s in xml.parse("mesh.pvd").getroot()[0]]
assert [(float(s["timestep"]), s["part"], s["file"]) for s in sets] == [
    (f / 50, str(p), "mesh_%s_%04d.vtu" % (n, f)) for f in (10, 12, 14) for p, n in enumerate(("flag", "rag"))], sets
sets = [s.attrib for s in xml.parse("colliders.pvd").getroot()[0]]
assert [(float(s["timestep"]), s["part"], s["file"]) for s in sets] == [
    (f / 50, p, n) for f in (10, 12, 14) for p, n in (("0", "colliders.vtu"), ("1", "colliders_%04d.vtu" % f))], sets
for number, name in enumerate(("colliders", "colliders_0014")):
    meshes = [meshio.read("%s.%s" % (name, format)) for format in ("vtu", "obj", "ply")]
    for mesh in meshes:
        assert (n.float32(mesh.points) == meshes[0].points).all() and mesh.cells_dict["triangle"].tolist() == [[0, 1, 2]]
    assert meshes[0].cell_data["collider"][0].ravel().tolist() == [number]
assert (meshes[0].points[1] == [0, n.float32(1 + 14 / 50), 0]).all()
)");
}

/// Returns the values of a bracketed list of a USD file.
std::vector<float> numbers(std::string text) {
    std::vector<float> values;
    for (char& c : text)
        if (c == '[' || c == ']' || c == '(' || c == ')' || c == ',') c = ' ';
    const char* at = text.c_str();
    for (char* end = nullptr;; at = end) {
        const float value = std::strtof(at, &end);
        if (end == at) return values;
        values.push_back(value);
    }
}

/// Returns the numbers on the line behind a key in a section.
std::vector<float> list_after(const std::string& text, std::string_view section, const std::string& key) {
    const std::size_t begin = text.find(key, text.find(section)) + key.size();
    return numbers(text.substr(begin, text.find('\n', begin) - begin));
}

// The text is tested here; tools/check_exports opens it with a USD library.
TEST(Usda, HasPointsAndFacesByFrame) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write("usda", folder);
    const std::string flag = read_text(temporary / "positions_flag.usda"),
                      rag = read_text(temporary / "positions_rag.usda");
    EXPECT_THAT(flag, testing::StartsWith("#usda 1.0\n(\n    defaultPrim = \"flag\"\n"));
    for (const char* line : {"    endTimeCode = 14 ", "    startTimeCode = 10\n", "    timeCodesPerSecond = 50\n",
                             "    upAxis = \"Y\"\n", "    metersPerUnit = 1\n", "def Mesh \"flag\"\n"})
        EXPECT_THAT(flag, testing::HasSubstr(line));
    EXPECT_THAT(rag, testing::HasSubstr("def Mesh \"_2nd_rag\"\n"));
    EXPECT_THAT(rag, testing::HasSubstr("    upAxis = \"Z\"\n"));
    for (const std::uint32_t frame : {10u, 12u, 14u})
        EXPECT_EQ(list_after(flag, "points.timeSamples", fmt::format("        {}: ", frame)), positions_of(frame, 6));
    const std::vector<float> whole(whole_flag.begin(), whole_flag.end()), cut(cut_flag.begin(), cut_flag.end());
    EXPECT_EQ(list_after(flag, "faceVertexIndices.timeSamples", "        10: "), whole);
    EXPECT_EQ(list_after(flag, "faceVertexIndices.timeSamples", "        12: "), cut);
    EXPECT_EQ(list_after(flag, "faceVertexCounts.timeSamples", "        12: "), std::vector<float>(3, 3));
    EXPECT_EQ(list_after(rag, "", "int[] faceVertexIndices = "), (std::vector<float>{0, 2, 1, 1, 2, 3}));
    EXPECT_EQ(list_after(rag, "", "primvars:st = ").size(), 8u);
    EXPECT_EQ(list_after(rag, "extent.timeSamples", "        14: ").size(), 6u);
}

TEST(Usda, CollidersAreMeshesThatMatricesMove) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write("usda", folder);
    const std::string text = read_text(temporary / "colliders.usda"), scene = read_text(temporary / "scene.usda");
    EXPECT_THAT(text, testing::StartsWith("#usda 1.0\n(\n    defaultPrim = \"colliders\"\n"));
    for (const char* line :
         {"    endTimeCode = 14\n", "    startTimeCode = 10\n", "def Xform \"colliders\"\n",
          "    def Mesh \"collider_1_mesh\"\n",
          "xformOp:transform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 3, 0, 1))\n",
          "        point3f[] points = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]\n", "int[] faceVertexIndices = [0, 1, 2]\n"})
        EXPECT_THAT(text, testing::HasSubstr(line));
    const std::size_t samples = text.find("xformOp:transform.timeSamples"), sample = text.find("14: ", samples);
    const std::vector<float> matrix = numbers(text.substr(sample + 4, text.find('\n', sample) - sample - 4));
    const auto c = static_cast<float>(std::cos(0.14 * std::numbers::pi)),
               s = static_cast<float>(std::sin(0.14 * std::numbers::pi));
    EXPECT_EQ(matrix, (std::vector<float>{c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0.28f, 0, 1}));
    for (const char* part : {"def \"flag\" (\n        references = @./positions_flag.usda@\n",
                             "def \"colliders\" (\n        references = @./colliders.usda@\n"})
        EXPECT_THAT(scene, testing::HasSubstr(part));
}

TEST(Usda, CollidersThatDeformHaveSamplesOfPoints) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    WrittenRun run = two_cloths();
    run.colliders[1].form = [](double time) { return std::vector<Vec3>{{1, time, 0}, {0, 1, 0}, {0, 0, 1}}; };
    write(*find_output_format("usda")->open(folder, run));
    const std::string text = read_text(temporary / "colliders.usda");
    const std::size_t deforming = text.find("\"collider_1_mesh\"");
    const std::string still = text.substr(0, deforming), moved = text.substr(deforming);
    EXPECT_THAT(still, testing::HasSubstr("point3f[] points = "));
    for (const std::uint32_t frame : {10u, 14u}) {
        const std::string sample = fmt::format("            {}: ", frame);
        const float now = static_cast<float>(frame / 50.0);
        EXPECT_EQ(list_after(moved, "points.timeSamples", sample), (std::vector<float>{1, now, 0, 0, 1, 0, 0, 0, 1}));
        EXPECT_EQ(list_after(moved, "extent.timeSamples", sample), (std::vector<float>{0, 0, 0, 1, 1, 1}));
    }
}

// A scene of several files has one that holds them.
TEST(Usda, SeveralClothsAreOneScene) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    WrittenRun run = two_cloths();
    run.colliders.clear();
    write(*find_output_format("usda")->open(folder, run));
    EXPECT_THAT(names_in(temporary.path()),
                testing::ElementsAre("positions_flag.usda", "positions_rag.usda", "scene.usda"));
}

// The file's time ends where the run ends.
TEST(Usda, EndsWithTheFramesThatCame) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write(*find_output_format("usda")->open(folder, two_cloths()), 1);
    EXPECT_THAT(read_text(temporary / "positions_flag.usda"),
                testing::AllOf(testing::HasSubstr("endTimeCode = 10 "), testing::HasSubstr("faceVertexIndices = [")));
}

}  // namespace
}  // namespace drape
