// One box is read from every kind of file; files that are no meshes are refused with their names.
#include "mesh/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "input/mesh_data.h"
#include "mesh/mesh_error.h"
#include "support/meshes.h"

namespace drape {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const Vec3 half{0.3, 0.2, 0.5};

std::string file_with(const std::string& name, const std::string& bytes) {
    std::string path = (fs::path(testing::TempDir()) / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string refusal(const std::string& path) {
    try {
        read_mesh(path, 1, std::nullopt);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "taken";
}

void expect_the_box(const std::string& path) {
    SCOPED_TRACE(path);
    const auto mesh = read_mesh(path, 1, std::nullopt);
    EXPECT_EQ(mesh->triangles().size(), 12u);
    EXPECT_EQ(mesh->vertices().size(), 8u);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(mesh->half_extents()[axis], half[axis], 1e-6);
    EXPECT_NEAR(mesh->distance({0, 0, 0}), -0.2, 1e-6);
}

std::string ascii_stl(const test::Triangles& mesh) {
    std::string text = "solid box\n";
    for (const Triangle& triangle : mesh.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::uint32_t corner : triangle) {
            const Vec3& v = mesh.vertices[corner];
            text += "vertex " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid box\n";
}

std::string ascii_ply(const test::Triangles& mesh) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& v : mesh.vertices)
        text += std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
    for (const auto& [a, b, c] : mesh.triangles)
        text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    return text;
}

/// A glTF file with its buffer beside it, and a node that doubles what is half as large.
std::string gltf(const test::Triangles& mesh, const std::string& name) {
    std::string bytes;
    const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const Vec3& v : mesh.vertices)
        for (const double entry : v) put(static_cast<float>(entry / 2));
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) put(static_cast<std::uint16_t>(corner));
    file_with(name + ".bin", bytes);
    return file_with(name, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "scale": [2, 2, 2]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"uri": ")" +
                               name + R"(.bin", "byteLength": 168}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                       "min": [-0.15, -0.1, -0.25], "max": [0.15, 0.1, 0.25]},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}]})");
}

TEST(MeshFileTest, EveryKindOfFileIsRead) {
    const test::Triangles box = test::box_mesh(half);
    expect_the_box(test::obj_file(box, "box.obj"));
    expect_the_box(file_with("box.stl", ascii_stl(box)));
    expect_the_box(file_with("box.ply", ascii_ply(box)));
    expect_the_box(file_with("box_upper.PLY", ascii_ply(box)));
    expect_the_box(gltf(box, "box.gltf"));
}

TEST(MeshFileTest, QuadsAreCutAndPartsAreJoined) {
    expect_the_box(file_with("quads.obj", R"(
o lower
v -.3 -0.2 -0.5
v +.3 -0.2 -.5
v -0.3 0.2 -0.5
v 0.3 0.2 -0.5
v -0.3 -0.2 0.5
v 0.3 -0.2 0.5
v -0.3 0.2 0.5
v 0.3 0.2 0.5
f 1 5 7 3 # left
f 2 4 8 6#right
o upper
f 1 2 6 5
f 3 7 8 4
f 1 3 4 2
f 5 6 8 7
)"));
}

TEST(MeshFileTest, ScaleIsMetresPerUnit) {
    const std::string path = test::obj_file(test::box_mesh({30, 20, 50}), "centimetres.obj");
    const auto mesh = read_mesh(path, 0.01, std::nullopt);
    EXPECT_NEAR(mesh->half_extents()[0], 0.3, 1e-6);
    EXPECT_EQ(read_mesh(path, 0.01, std::nullopt), mesh);
    EXPECT_NE(read_mesh(path, 0.02, std::nullopt), mesh);
}

TEST(MeshFileTest, FilesThatAreNoMeshesAreRefused) {
    EXPECT_THAT(refusal("missing.obj"), HasSubstr("cannot read missing.obj: "));
    EXPECT_THAT(refusal(testing::TempDir()), HasSubstr("it is not a file"));
    EXPECT_THAT(refusal(file_with("notes.txt", "v 0 0 0")), HasSubstr("ends in .obj, .ply, .stl, .gltf or .glb"));
    EXPECT_THAT(refusal(file_with("comma.obj", "v 0 0 0\nv 0,5 0 0\nv 0 1 0\nf 1 2 3\n")),
                HasSubstr("comma.obj': line 2 is no vertex of three numbers"));
    EXPECT_THAT(refusal(file_with("words.obj", "once upon a time")), HasSubstr("words.obj"));
    EXPECT_THAT(refusal(file_with("empty.ply", "")), HasSubstr("empty.ply': line 1: "));
    EXPECT_THAT(refusal(file_with("json.gltf", "{\"asset\": ")), HasSubstr("json.gltf': it is no glTF: * Line 1"));
    EXPECT_THAT(refusal(file_with("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")), HasSubstr("points.obj"));
    EXPECT_THAT(refusal(file_with("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), HasSubstr("nan.obj"));
    const std::string large = file_with("large.stl", "solid");
    fs::resize_file(large, input::mesh_file_byte_limit + 1);
    EXPECT_THAT(refusal(large),
                HasSubstr("expected a mesh file of at most 268435456 bytes, got " + large + " of 268435457"));
    fs::remove(large);
}

TEST(MeshFileTest, TooManyTrianglesAreRefused) {
    // A binary STL has 50 bytes a triangle.
    std::string bytes(84 + 50 * (input::mesh_triangle_limit + 1), '\0');
    const auto count = static_cast<std::uint32_t>(input::mesh_triangle_limit + 1);
    std::memcpy(bytes.data() + 80, &count, sizeof count);
    const std::string path = file_with("many.stl", bytes);
    EXPECT_THAT(refusal(path), HasSubstr("expected at most 4000000 triangles"));
    fs::remove(path);
}

}  // namespace
}  // namespace drape
