// Every output format keeps the common promises, and readers that share nothing with it find the right contents.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>
#include <sstream>

#include "input/png_picture.h"
#include "output/frame_writer.h"
#include "temporary_folder.h"
#include "written_runs.h"

namespace drape {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Format : public testing::TestWithParam<const OutputFormat*> {};

TEST_P(Format, OwnsTheNamesOfItsFilesAndRecordsThem) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    const std::vector<FileRecord> files = write(*GetParam()->open(folder, two_cloths()));
    std::set<std::string> names;
    for (const FileRecord& file : files) {
        const std::string bytes = read_text(temporary / file.name);
        EXPECT_EQ(file.bytes, bytes.size());
        EXPECT_EQ(file.hash, xxh3_128_hex(bytes));
        EXPECT_TRUE(GetParam()->owns(file.name)) << file.name;
        EXPECT_TRUE(is_output_file_name(file.name)) << file.name;
        EXPECT_TRUE(is_temporary_file_name(file.name + ".tmp-1")) << file.name;
        names.insert(file.name);
    }
    EXPECT_FALSE(names.empty());
    EXPECT_EQ(names_in(temporary.path()), names);
}

TEST_P(Format, OwnsNoOtherNames) {
    for (const char* name : {"notes.txt", "positions", "positions.", "frame_1.png", "frame_a_0001.png", "mesh.obj",
                             "mesh_1.obj", "faces_x.npy", "positionsX.npz", "positions_.npz", "manifest.json",
                             "colliders_1.obj", "colliders_a_0001.obj", "collidersX.ply", "colliders.npz"})
        EXPECT_FALSE(GetParam()->owns(name)) << name;
}

TEST_P(Format, TheSameFramesGiveTheSameBytes) {
    const TemporaryFolder temporary;
    OutputFolder one(temporary / "one"), two(temporary / "two");
    EXPECT_EQ(write(*GetParam()->open(one, two_cloths())), write(*GetParam()->open(two, two_cloths())));
}

TEST_P(Format, AnUnfinishedRunLeavesOnlyTheFilesOfFrames) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write(*GetParam()->open(folder, two_cloths()), 2, false);
    for (const std::string& name : names_in(temporary.path())) {
        EXPECT_FALSE(is_temporary_file_name(name)) << name;
        EXPECT_TRUE(GetParam()->frame_files || name.starts_with("faces_")) << name;
    }
}

TEST_P(Format, AFullDiskIsSaidAndLeavesNoHalfFile) {
    const TemporaryFolder temporary;
    const pid_t child = start_child([&] {
        OutputFolder folder(temporary.path());
        const rlimit limit{60, 60};  // bytes
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
        const std::string text = error_text<OutputError>([&] { write(*GetParam()->open(folder, two_cloths())); });
        return text.starts_with("cannot write '") && text.ends_with("': File too large") ? 0 : 1;
    });
    EXPECT_EQ(wait_for(child), 0);
    EXPECT_THAT(names_in(temporary.path()), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Of, Format, testing::ValuesIn(output_formats().begin(), output_formats().end()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST(WrittenCloth, TextureCoordinatesOfAnOutlineAreItsPlaces) {
    const WrittenCloth grid{.columns = 2, .rows = 2, .size = {4, 2}},
        outlined{.columns = 2, .rows = 2, .size = {4, 2}, .panel = {{0, 0}, {3, 0.5}, {0, 2}, {4, 1.5}}};
    EXPECT_EQ(grid.uv(1), (std::array<float, 2>{1, 1}));
    EXPECT_EQ(outlined.uv(1), (std::array<float, 2>{0.75, 0.75}));
    EXPECT_EQ(outlined.uv(3), (std::array<float, 2>{1, 0.25}));
}

TEST(Formats, HaveNamesOfTheirOwn) {
    for (const OutputFormat* format : output_formats()) EXPECT_EQ(find_output_format(format->name), format);
    EXPECT_EQ(find_output_format("fbx"), nullptr);
    EXPECT_EQ(export_format_names(false),
              "npy, npz, pc2, obj, ply, usda, vtu, mgn, depth, normal, id, strain, depth16, normal16, id16, strain16");
    EXPECT_EQ(export_format_names(true),
              "npy, npz, pc2, obj, ply, usda, vtu, mgn, y4m, rgb, depth, normal, id, strain, depth16, normal16, id16, "
              "strain16");
    EXPECT_EQ(stream_format_names(), "y4m, rgb");
}

/// Returns the values of an array file, whose header says this type and shape.
template <class Value>
std::vector<Value> array_in(const std::filesystem::path& file, const std::string& type, const std::string& shape) {
    const std::string bytes = read_text(file);
    EXPECT_THAT(bytes.substr(0, 128), testing::HasSubstr("'descr': '" + type + "'"));
    EXPECT_THAT(bytes.substr(0, 128), testing::HasSubstr("'shape': (" + shape + ")"));
    std::vector<Value> values((bytes.size() - 128) / sizeof(Value));
    std::memcpy(values.data(), bytes.data() + 128, bytes.size() - 128);
    return values;
}

TEST(Layers, AreNumbersOfEachPixel) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    for (const char* format : {"depth", "normal", "id", "strain"}) write(format, folder);
    const auto depth = array_in<float>(temporary / "depth_0012.npy", "<f4", "2, 4");
    ASSERT_EQ(depth.size(), 8u);
    EXPECT_EQ(depth[0], std::numeric_limits<float>::infinity());
    EXPECT_EQ(std::vector<float>(depth.begin() + 5, depth.end()), (std::vector<float>{12, 30, 1e6f}));
    const auto normal = array_in<float>(temporary / "normal_0012.npy", "<f4", "2, 4, 3");
    EXPECT_EQ(std::vector<float>(normal.begin(), normal.begin() + 12),
              (std::vector<float>{0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, -1}));
    EXPECT_EQ(array_in<std::uint16_t>(temporary / "id_0012.npy", "<u2", "2, 4"),
              (std::vector<std::uint16_t>{0, 1, 3, 65535, 0, 1, 3, 65535}));
    EXPECT_EQ(array_in<float>(temporary / "strain_0012.npy", "<f4", "2, 4"),
              (std::vector<float>{0, 0.25f, 0, 0, 0, 0.25f, 0, 0}));
    EXPECT_EQ(names_in(temporary.path()).size(), 12u);
}

TEST(Layers, AreSixteenBitPictures) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    for (const char* format : {"depth16", "normal16", "id16", "strain16"}) write(format, folder);
    const auto row_of = [&](const char* name) {
        const std::string bytes = read_text(temporary / name);
        const GreyPicture picture = decode_grey_png(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
        EXPECT_EQ(picture.width, 4u);
        EXPECT_EQ(picture.height, 2u);
        std::vector<long> levels;
        for (std::size_t i = 0; i < 4; ++i)
            levels.push_back(std::lround(65535 * static_cast<double>(picture.values[i])));
        return levels;
    };
    EXPECT_EQ(row_of("depth_0012.png"), (std::vector<long>{0, 12000, 30000, 65535}));
    EXPECT_EQ(row_of("id_0012.png"), (std::vector<long>{0, 1, 3, 65535}));
    EXPECT_EQ(row_of("strain_0012.png"), (std::vector<long>{0, 35268, 32768, 32768}));
    const std::string colours = read_text(temporary / "normal_0012.png");
    const Picture normals = decode_png(std::vector<std::uint8_t>(colours.begin(), colours.end()));
    EXPECT_EQ(std::vector<std::uint8_t>(normals.rgb.begin(), normals.rgb.begin() + 9),
              (std::vector<std::uint8_t>{0, 0, 0, 128, 255, 128, 0, 128, 128}));
}

struct Mesh {
    Positions positions, uv;
    std::vector<std::uint32_t> faces;
};

Mesh read_obj(const std::string& text) {
    Mesh mesh;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, value;
        words >> key;
        while (words >> value) {
            if (key == "v") mesh.positions.push_back(std::strtof(value.c_str(), nullptr));
            if (key == "vt") mesh.uv.push_back(std::strtof(value.c_str(), nullptr));
            if (key == "f") {
                const std::size_t slash = value.find('/');
                if (slash != std::string::npos) {
                    EXPECT_EQ(value.substr(0, slash), value.substr(slash + 1));
                }
                mesh.faces.push_back(static_cast<std::uint32_t>(std::stoul(value)) - 1);
            }
        }
    }
    return mesh;
}

Mesh read_ply(const std::string& bytes) {
    const std::string end = "end_header\n";
    std::istringstream header(bytes.substr(0, bytes.find(end)));
    std::size_t vertices = 0, faces = 0;
    std::vector<std::string> properties;
    for (std::string line; std::getline(header, line);) {
        std::sscanf(line.c_str(), "element vertex %zu", &vertices);
        std::sscanf(line.c_str(), "element face %zu", &faces);
        if (line.starts_with("property")) properties.push_back(line.substr(line.rfind(' ') + 1));
    }
    const bool has_uv = properties.size() > 4;
    if (has_uv)
        EXPECT_THAT(properties, ElementsAre("x", "y", "z", "s", "t", "vertex_indices"));
    else
        EXPECT_THAT(properties, ElementsAre("x", "y", "z", "vertex_indices"));
    Mesh mesh;
    const char* at = bytes.data() + bytes.find(end) + end.size();
    const auto take = [&at](auto& list, std::size_t count) {
        if (count == 0) return;
        list.resize(list.size() + count);
        std::memcpy(list.data() + list.size() - count, at, count * sizeof list[0]);
        at += count * sizeof list[0];
    };
    for (std::size_t i = 0; i < vertices; ++i) take(mesh.positions, 3), take(mesh.uv, has_uv ? 2 : 0);
    for (std::size_t i = 0; i < faces; ++i) {
        EXPECT_EQ(*at++, 3);
        take(mesh.faces, 3);
    }
    EXPECT_EQ(at, bytes.data() + bytes.size());
    return mesh;
}

using MeshReader = Mesh (*)(const std::string&);

void expect_meshes(const char* format, MeshReader read) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write(format, folder);
    const auto mesh = [&](const char* cloth, int frame) {
        return read(read_text(temporary / fmt::format("mesh_{}_{:04}.{}", cloth, frame, format)));
    };
    for (const int frame : {10, 12, 14}) {
        EXPECT_EQ(mesh("flag", frame).positions, positions_of(frame, 6)) << frame;
        EXPECT_EQ(mesh("flag", frame).faces, frame < 12 ? whole_flag : cut_flag) << frame;
        EXPECT_EQ(mesh("rag", frame).positions, positions_of(frame, 4)) << frame;
        EXPECT_EQ(mesh("rag", frame).faces, two_cloths().cloths[1].faces);
    }
    EXPECT_EQ(mesh("flag", 10).uv, (Positions{0, 1, 0.5, 1, 1, 1, 0, 0, 0.5, 0, 1, 0}));
    EXPECT_EQ(names_in(temporary.path()).size(), 6u + 1 + 3);
    const auto colliders = [&](const std::string& name) { return read(read_text(temporary / (name + "." + format))); };
    const Mesh still = colliders("colliders"), moved = colliders("colliders_0010");
    EXPECT_EQ(still.positions, (Positions{1, 3, 0, 0, 4, 0, 0, 3, 1}));
    EXPECT_EQ(still.faces, (std::vector<std::uint32_t>{0, 1, 2}));
    const auto c = static_cast<float>(std::cos(0.1 * std::numbers::pi)),
               s = static_cast<float>(std::sin(0.1 * std::numbers::pi));
    EXPECT_EQ(moved.positions, (Positions{c, 0.2f, -s, 0, 1.2f, 0, s, 0.2f, c}));
    EXPECT_EQ(moved.faces, still.faces);
}

TEST(Obj, HasEveryParticleAndTheFacesOfItsFrame) { expect_meshes("obj", read_obj); }
TEST(Ply, HasEveryParticleAndTheFacesOfItsFrame) { expect_meshes("ply", read_ply); }

TEST(Pc2, HasEverySampleInTheOrderOfItsMesh) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write("pc2", folder);
    EXPECT_THAT(names_in(temporary.path()),
                ElementsAre("positions_flag.obj", "positions_flag.pc2", "positions_rag.obj", "positions_rag.pc2"));
    const std::string cache = read_text(temporary / "positions_flag.pc2");
    struct {
        char signature[12];
        std::int32_t version, points;
        float start, rate;
        std::int32_t samples;
    } header;
    std::memcpy(&header, cache.data(), sizeof header);
    EXPECT_STREQ(header.signature, "POINTCACHE2");
    EXPECT_EQ(header.version, 1);
    EXPECT_EQ(header.points, 6);
    EXPECT_EQ(header.start, 10);
    EXPECT_EQ(header.rate, 2);
    ASSERT_EQ(header.samples, 3);
    ASSERT_EQ(cache.size(), 32u + 3 * 6 * 12);
    for (std::uint32_t sample = 0; sample < 3; ++sample) {
        Positions values(18);
        std::memcpy(values.data(), cache.data() + 32 + sample * 72, 72);
        EXPECT_EQ(values, positions_of(10 + 2 * sample, 6));
    }
    const Mesh base = read_obj(read_text(temporary / "positions_flag.obj"));
    EXPECT_EQ(base.positions, positions_of(10, 6));
    EXPECT_EQ(base.faces, whole_flag);
}

// Blender drops vertices of an OBJ that no face uses; the cache must fit the rest.
TEST(Pc2, LeavesOutParticlesWithoutTriangles) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    WrittenRun run = two_cloths();
    run.cloths[0].faces = {1, 3, 4, 1, 4, 2};  // neither 0 nor 5
    write(*find_output_format("pc2")->open(folder, run));
    const std::string cache = read_text(temporary / "positions_flag.pc2");
    EXPECT_EQ(cache.size(), 32u + 3 * 4 * 12);
    Positions values(12);
    std::memcpy(values.data(), cache.data() + 32, 48);
    const Positions all = positions_of(10, 6);
    EXPECT_EQ(values, Positions(all.begin() + 3, all.begin() + 15));
    const Mesh base = read_obj(read_text(temporary / "positions_flag.obj"));
    EXPECT_EQ(base.positions, values);
    EXPECT_EQ(base.faces, (std::vector<std::uint32_t>{0, 2, 3, 0, 3, 1}));
    EXPECT_EQ(base.uv, (Positions{0.5, 1, 1, 1, 0, 0, 0.5, 0}));
}

// The count is right after a run that ends early.
TEST(Pc2, CountsTheSamplesThatCame) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write(*find_output_format("pc2")->open(folder, two_cloths()), 1);
    const std::string cache = read_text(temporary / "positions_rag.pc2");
    std::int32_t samples = 0;
    std::memcpy(&samples, cache.data() + 28, 4);
    EXPECT_EQ(samples, 1);
    EXPECT_EQ(cache.size(), 32u + 4 * 12);
}

// A run is refused where its files would not fit: the bytes asked for must be no more than they take.
TEST(Formats, TakeAtLeastTheBytesThatAreAskedFor) {
    for (const char* name : {"npz", "mgn", "ply", "vtu"})
        for (const bool packed : {false, true}) {
            const TemporaryFolder temporary;
            OutputFolder folder(temporary.path());
            WrittenRun run = two_cloths();
            run.deflates = packed;
            const FrameSize size{
                .particles = 10, .moving_vertices = 3, .moving_triangles = 1, .obstacle_nodes = 6, .packed = packed};
            std::uint64_t bytes = 0;
            for (const FileRecord& file : write(*find_output_format(name)->open(folder, run))) bytes += file.bytes;
            const std::uint64_t waiting = find_output_format(name)->is_archive ? 3u * (name[0] == 'n' ? 260 : 192) : 0;
            EXPECT_LE(3 * find_output_format(name)->frame_bytes(size), bytes + waiting) << name;
        }
    const FrameSize moving{.moving_vertices = 1000, .moving_triangles = 2000, .obstacle_nodes = 1000};
    EXPECT_EQ(find_output_format("ply")->frame_bytes(moving), 38000u);
    EXPECT_EQ(find_output_format("vtu")->frame_bytes(moving), 86000u);
    EXPECT_EQ(find_output_format("mgn")->frame_bytes(moving), 24000u);
}

// An object is found by its collider's name, and a file with many numbers its vertices through.
TEST(Obj, HasAnObjectForEveryCollider) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    WrittenRun run = two_cloths();
    run.colliders = {triangle_collider(false), triangle_collider(false)};
    run.colliders[1].name = "collider_1_mesh";
    write(*find_output_format("obj")->open(folder, run));
    const std::string text = read_text(temporary / "colliders.obj");
    EXPECT_LT(text.find("o collider_0_mesh\n"), text.find("o collider_1_mesh\n"));
    EXPECT_EQ(read_obj(text).faces, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(names_in(temporary.path()).size(), 6u + 1);
}

TEST(Npz, NumpyReadsIt) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write("npz", folder);
    write("npy", folder);
    write_text(temporary / "check.py", R"(
import sys, zipfile, numpy as n
import json
flag, rag = n.load("positions_flag.npz"), n.load("positions_rag.npz")
common = {"positions", "velocities", "contacts", "faces", "uv", "frames", "times", "substeps", "seed", "parameters", "scene"}
assert set(flag) == common | {"faces_0012", "energy_j", "stretch_error_rms"}, sorted(flag)
assert set(rag) == common, sorted(rag)
for name, cloth in (("flag", flag), ("rag", rag)):
    positions = n.load("positions_%s.npy" % name)
    assert cloth["positions"].dtype == n.dtype("<f4") and (cloth["positions"] == positions).all()
    assert cloth["velocities"].dtype == n.dtype("<f4") and cloth["velocities"].shape == positions.shape
    assert (cloth["contacts"] == n.arange(positions[0, ..., 0].size).reshape(positions.shape[1:3]) - 1).all()
    assert cloth["contacts"].dtype == n.int16 and len(cloth["contacts"]) == 3
    assert (cloth["faces"] == n.load("faces_%s_0000.npy" % name)).all()
assert flag["velocities"][0, 0, 0, 0] == n.float32(12 / 3)
assert flag["frames"].tolist() == [10, 12, 14] and flag["substeps"].tolist() == [4, 4, 4]
assert flag["energy_j"].tolist() == [10, 12, 14]
assert n.isnan(flag["stretch_error_rms"]).tolist() == [True, False, True] and flag["stretch_error_rms"][1] == 0.25
assert flag["seed"] == 7 and flag["seed"].shape == ()
assert json.loads(flag["scene"].item()) == {"name": "\u00e9"} and json.loads(str(flag["parameters"])) == {"method": "line"}
assert flag["positions"].shape == (3, 2, 3, 3) and flag["uv"].shape == (2, 3, 2)
assert flag["uv"][0, 1].tolist() == [0.5, 1] and flag["uv"][1, 2].tolist() == [1, 0]
assert (flag["faces_0012"] == n.load("faces_flag_0012.npy")).all() and flag["faces_0012"].shape == (3, 3)
assert flag["times"].dtype == n.float64 and flag["times"].tolist() == [10 / 50, 12 / 50, 14 / 50]
archive = zipfile.ZipFile("positions_flag.npz")
assert archive.testzip() is None
assert all(part.date_time == (1980, 1, 1, 0, 0, 0) for part in archive.infolist())
)");
    EXPECT_EQ(std::system(fmt::format("cd {} && /usr/bin/python3 check.py", temporary.path().string()).c_str()), 0);
}

// A run of frames that are alike shows that something is packed.
TEST(Npz, NumpyReadsAPackedOneLikeAnyOther) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path()), packed(temporary / "packed");
    WrittenRun run = two_cloths();
    run.scene = std::string(20000, ' ');
    for (const char* format : {"npz", "mgn"}) {
        run.deflates = false;
        write(*find_output_format(format)->open(folder, run));
        run.deflates = true;
        write(*find_output_format(format)->open(packed, run));
    }
    write_text(temporary / "check.py", R"(
import numpy as n, os, zipfile
for name in ("positions_flag.npz", "positions_rag.npz", "trajectory.npz"):
    one, packed = n.load(name), n.load("packed/" + name)
    assert one.files == packed.files
    for key in one.files:
        assert one[key].dtype == packed[key].dtype and n.array_equal(one[key], packed[key], equal_nan=one[key].dtype.kind == "f")
    assert all(part.compress_type == zipfile.ZIP_DEFLATED for part in zipfile.ZipFile("packed/" + name).infolist())
    assert all(part.compress_type == zipfile.ZIP_STORED for part in zipfile.ZipFile(name).infolist())
assert os.path.getsize("packed/positions_flag.npz") < 0.2 * os.path.getsize("positions_flag.npz")
)");
    EXPECT_EQ(std::system(fmt::format("cd {} && /usr/bin/python3 check.py", temporary.path().string()).c_str()), 0);
}

TEST(Mgn, NumpyReadsCollidersAsObstacles) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    write("mgn", folder);
    write("npy", folder);
    write_text(temporary / "check.py", R"(
import numpy as n
run = n.load("trajectory.npz")
assert run["node_type"][0, :, 0].tolist() == 10 * [0] + 6 * [1]
assert run["cells"][0, -2:].tolist() == [[10, 11, 12], [13, 14, 15]] and run["cells"].max() == 15
assert (run["mesh_pos"][0, 10:] == 0).all() and run["mesh_pos"].shape == (1, 16, 2)
world = run["world_pos"]
assert world.shape == (3, 16, 3)
assert (world[:, :6] == n.load("positions_flag.npy").reshape(3, 6, 3)).all()
assert (world[:, 10:13] == [[1, 3, 0], [0, 4, 0], [0, 3, 1]]).all()
assert (world[:, 14] == [[0, n.float32(1 + f / 50), 0] for f in (10, 12, 14)]).all()
angle = n.pi / 2 * n.array([10, 12, 14]) / 50
assert n.allclose(world[:, 13], n.transpose([n.cos(angle), n.array([10, 12, 14]) / 50, -n.sin(angle)]), atol=1e-7)
)");
    EXPECT_EQ(std::system(fmt::format("cd {} && /usr/bin/python3 check.py", temporary.path().string()).c_str()), 0);
}

// A triangle has as many corners as before; eight pieces of each edge have nodes between them.
TEST(WrittenColliders, FlatOnesGetNodes) {
    WrittenCollider flat = triangle_collider(false);
    EXPECT_EQ(with_nodes(flat).vertices.size(), 3u);
    flat.flat = true;
    const WrittenCollider divided = with_nodes(flat);
    EXPECT_EQ(divided.faces.size(), 3u * 64);
    EXPECT_EQ(divided.vertices.size(), 45u);
    for (const Vec3& at : divided.vertices) {
        EXPECT_EQ(at[0] + at[1] + at[2], 1);
        for (const double x : at) EXPECT_EQ(x * 8, std::floor(x * 8));
    }
    EXPECT_EQ(placed_vertices(divided, 0).size(), 135u);
}

}  // namespace
}  // namespace drape
