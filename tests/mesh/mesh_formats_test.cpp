// Every form that a mesh format has is read as one box, and what a file claims and does not hold is refused at its
// place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <functional>

#include "mesh/mesh_error.h"
#include "mesh/mesh_file.h"
#include "support/meshes.h"

namespace drape {
namespace {

using test::Triangles;
using testing::HasSubstr;

const Vec3 half_box{0.5, 0.25, 1};  // exact in single precision

Triangles box() { return test::box_mesh(half_box); }

std::string file_of(const std::string& name, const std::string& bytes) {
    std::string path = (std::filesystem::path(testing::TempDir()) / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

void expect_box(const std::string& name, const std::string& bytes) {
    SCOPED_TRACE(name);
    const auto mesh = read_mesh(file_of(name, bytes), 1, std::nullopt);
    EXPECT_EQ(mesh->triangles().size(), 12u);
    EXPECT_EQ(mesh->vertices().size(), 8u);
    EXPECT_EQ(mesh->half_extents(), half_box);
    EXPECT_EQ(mesh->volume(), 1);
}

std::string refusal_of(const std::string& name, const std::string& bytes) {
    try {
        read_mesh(file_of(name, bytes), 1, std::nullopt);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "taken";
}

template <class T>
std::string bytes_of(T value, bool big = false) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string text_of(const std::vector<Vec3>& vertices) {
    std::string text;
    for (const auto& [x, y, z] : vertices)
        text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    return text;
}

std::string with_ends(std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size()) text.replace(at, 1, end);
    return text;
}

std::string obj_text(const std::string& indent) {
    std::string text;
    for (const auto& [x, y, z] : box().vertices)
        text += indent + "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    for (const auto& [a, b, c] : box().triangles)
        text += indent + "f " + std::to_string(a + 1) + "/1/2 " + std::to_string(b + 1) + "//3 " +
                std::to_string(static_cast<int>(c) - 8) + "\n";
    return text;
}

TEST(ObjFile, LinesEndAndBeginAsTheyMay) {
    expect_box("plain.obj", obj_text(""));
    expect_box("crlf.obj", with_ends(obj_text(""), "\r\n"));
    expect_box("cr.obj", with_ends(obj_text(""), "\r"));
    expect_box("indented.obj", obj_text(" \t"));
    expect_box("bom.obj", "\xEF\xBB\xBF" + obj_text(""));
    std::string continued = obj_text("");
    for (std::size_t at = 0; (at = continued.find("//3 ", at)) != continued.npos; ++at)
        continued.insert(at + 4, "\\\n");
    expect_box("continued.obj", continued);
    const std::string faces_first = obj_text("");
    const std::size_t first_face = faces_first.find("f ");
    // Numbers that count back would name other vertices there.
    EXPECT_THAT(refusal_of("first.obj", faces_first.substr(first_face) + faces_first.substr(0, first_face)),
                HasSubstr("line 1 is no face of vertices that are there"));
    EXPECT_THAT(refusal_of("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\nf 1 2 4\n"),
                HasSubstr("line 5 is no face"));
    EXPECT_THAT(refusal_of("glued.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3x\n"), HasSubstr("line 4 is no face"));
}

struct PlyForm {
    const char* format;
    bool big = false;
};

/// Vertices with a colour between y and z and a list behind, faces with a quality before their corners.
std::string binary_ply(const PlyForm& form) {
    std::string text = std::string("ply\nformat ") + form.format +
                       " 1.0\ncomment a box\nelement camera 1\nproperty double view\nelement nothing 4000000000\n"
                       "element vertex 8\nproperty double x\nproperty float32 y\nproperty uchar red\nproperty float z\n"
                       "property list ushort short seen\nelement face 12\nproperty int8 quality\n"
                       "property list uint8 uint vertex_index\nend_header\n";
    text += bytes_of(1.0, form.big);
    for (const auto& [x, y, z] : box().vertices) {
        text += bytes_of(x, form.big) + bytes_of(static_cast<float>(y), form.big) + '\n';
        text += bytes_of(static_cast<float>(z), form.big);
        text += bytes_of(std::uint16_t{2}, form.big) + bytes_of(std::int16_t{1}, form.big) + bytes_of(std::int16_t{-1});
    }
    for (const Triangle& triangle : box().triangles) {
        text += "q\3";
        for (const std::uint32_t corner : triangle) text += bytes_of(corner, form.big);
    }
    return text;
}

const std::string ply_vertices = "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n";

std::string ascii_ply() {
    std::string text = "ply\nformat ascii 1.0\n" + ply_vertices +
                       "element face 12\nproperty list uchar int vertex_indices\nend_header\n" +
                       text_of(box().vertices);
    for (const auto& [a, b, c] : box().triangles)
        text += "3 " + std::to_string(a) + " " + std::to_string(b) + "\t" + std::to_string(c) + " \n";
    return text;
}

TEST(PlyFile, EveryEncodingIsRead) {
    expect_box("ascii.ply", ascii_ply());
    expect_box("crlf.ply", with_ends(ascii_ply(), "\r\n"));
    expect_box("cr.ply", with_ends(ascii_ply(), "\r"));
    expect_box("little.ply", binary_ply({"binary_little_endian"}));
    expect_box("big.ply", binary_ply({"binary_big_endian", true}));
}

TEST(PlyFile, StripsAreTakenApart) {
    // The sides of a box as one strip, bottom and top as strips of their own; box_mesh numbers x fastest, then y.
    const Triangles mesh = box();
    std::vector<Vec3> corners;
    for (const double z : {-1.0, 1.0})
        for (const double y : {-0.25, 0.25})
            for (const double x : {-0.5, 0.5}) corners.push_back({x, y, z});
    const std::string text = "ply\nformat ascii 1.0\n" + ply_vertices +
                             "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                             text_of(corners) + "20 0 4 1 5 3 7 2 6 0 4 -1 0 1 2 3 -1 4 6 5 7\n";
    expect_box("strips.ply", text);
}

TEST(PlyFile, WhatIsNotThereIsRefusedAtItsPlace) {
    const auto header = [](const std::string& rest) { return "ply\nformat binary_little_endian 1.0\n" + rest; };
    const std::string whole = ascii_ply(), binary = binary_ply({"binary_little_endian"});
    const struct {
        std::string bytes;
        const char* error;
    } cases[] = {
        // Eight vertices without a byte each, which a reader that trusts the header reads for ever.
        {header("element vertex 8\nproperend_header\n") + std::string(20, '\0'), "line 4: expected format, element"},
        {header("element vertex 8\nend_header\n"), "expected triangles, "},
        {header("element vertex 4000000000\nproperty char x\nproperty char y\nproperty char z\nend_header\nabc"),
         "line 3: 4000000000 times \"vertex\" need 3 bytes each at least, the file has 3 left"},
        {header("element vertex 1\nproperty float x\nproperty float y\nend_header\n12345678"),
         "line 3: a vertex has no number z"},
        {header("element face 1\nproperty list int int vertex_indices\nend_header\n") + bytes_of(0x7fffffff),
         "byte 103: a list is longer than the file"},
        {header("element face 1\nproperty list char int vertex_indices\nend_header\n\xff"), "a list is longer"},
        {header("element face 1\nproperty list float int vertex_indices\nend_header\n"),
         "line 4: expected a list counted"},
        {header("element face\n"), "line 3: expected an element's name and number"},
        {header("property float x\n"), "line 3: a property stands before every element"},
        {header("element vertex 1\nproperty quad x\n"), "line 4: expected a type of numbers, got \"quad\""},
        {header("comment without an end"), "line 3: the header has no end"},
        {"ply\nend_header\n", "the header says no format"},
        {"ply\nformat ternary 1.0\n", "line 2: expected ascii,"},
        {"plx\n", "line 1: the first line"},
        {whole.substr(0, whole.size() - 3), "line 29: the file ends too early"},
        {whole.substr(0, whole.size() - 3) + "8 ", "a face has the corner 8, there are 8 vertices"},
        {whole.substr(0, whole.size() - 3) + "0.5 ", "line 29: expected a whole number"},
        {whole.substr(0, whole.size() - 3) + "x ", "line 29: expected a whole number"},
        {binary.substr(0, binary.size() - 1), "the file ends too early"},
    };
    for (const auto& [bytes, error] : cases)
        EXPECT_THAT(refusal_of("refused.ply", bytes), HasSubstr(error)) << bytes.substr(0, 120);
}

std::string binary_stl(const std::string& head) {
    std::string bytes = head + std::string(80 - head.size(), '\0') + bytes_of(std::uint32_t{12});
    const Triangles mesh = box();
    for (const Triangle& triangle : mesh.triangles) {
        bytes += std::string(12, '\0');
        for (const std::uint32_t corner : triangle)
            for (const double x : mesh.vertices[corner]) bytes += bytes_of(static_cast<float>(x));
        bytes += "\1\2";
    }
    return bytes;
}

TEST(StlFile, BinaryFilesAreReadWhateverTheirHeadSays) {
    expect_box("binary.stl", binary_stl("a box"));
    expect_box("solid.stl", binary_stl("solid box"));
    expect_box("longer.stl", binary_stl("a box") + "trailing");
    EXPECT_THAT(refusal_of("short.stl", binary_stl("a box").substr(0, 680)),
                HasSubstr("12 triangles, as byte 80 says, need 684 bytes, it has 680"));
    EXPECT_THAT(refusal_of("tiny.stl", "box"), HasSubstr("neither begins with \"solid\" nor has 84 bytes"));
}

TEST(StlFile, AsciiLoopsHaveThreeVertices) {
    const std::string begin = "\xEF\xBB\xBFSOLID a\n FACET NORMAL 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n";
    EXPECT_THAT(refusal_of("two.stl", begin + " endloop\n"), HasSubstr("line 6: a loop has fewer than three"));
    EXPECT_THAT(refusal_of("four.stl", begin + "vertex 0 1 0\nvertex 1 1 0\n"), HasSubstr("line 7: a loop has more"));
    EXPECT_THAT(refusal_of("word.stl", begin + "vertex 0 one 0\n"), HasSubstr("line 6: expected three numbers"));
    EXPECT_THAT(refusal_of("end.stl", begin), HasSubstr("ends within a loop"));
    EXPECT_THAT(refusal_of("open.stl", begin + "vertex 0 1 0\nendloop\nendfacet\n"),
                HasSubstr("3 edges of one triangle"));
}

/// The box's floats and, behind them, 16-bit corners.
std::string box_buffer() {
    const Triangles mesh = box();
    std::string bytes;
    for (const Vec3& v : mesh.vertices)
        for (const double x : v) bytes += bytes_of(static_cast<float>(x));
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) bytes += bytes_of(static_cast<std::uint16_t>(corner));
    return bytes;
}

std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t held = 0;
        for (std::size_t j = 0; j < 3; ++j)
            held = held << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0);
        for (int shift = 18; shift >= 0; shift -= 6) text += digits[held >> shift & 63];
    }
    return text;
}

/// A node turned by half a turn about z within one that moves it: what is read is the box again.
std::string gltf_json(const std::string& buffer) {
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [1]}],
"nodes": [{"mesh": 0, "rotation": [0, 0, 1, 0], "translation": [0, 0, -3]},
          {"children": [0], "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]}],
"meshes": [{"primitives": [{"mode": 1, "attributes": {}}, {"attributes": {"POSITION": 0}, "indices": 1}]}],
"buffers": [{)" +
           buffer + R"("byteLength": 168}],
"bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
              {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}]})";
}

std::string glb(std::string json, std::string binary) {
    while (json.size() % 4 != 0) json += ' ';
    const auto chunk = [](const std::string& bytes, const char* type) {
        return bytes_of(static_cast<std::uint32_t>(bytes.size())) + std::string(type, 4) + bytes;
    };
    const std::string chunks = chunk(json, "JSON") + chunk(binary, "BIN\0");
    return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

TEST(GltfFile, BuffersLieInsideOrBeside) {
    expect_box("inside.glb", glb(gltf_json(""), box_buffer()));
    expect_box("data.gltf",
               gltf_json("\"uri\": \"data:application/octet-stream;base64," + base64(box_buffer()) + "\", "));
    file_of("a box.bin", box_buffer());
    expect_box("beside.gltf", gltf_json("\"uri\": \"a%20box.bin\", "));
}

TEST(GltfFile, WhatIsNotThereIsRefusedAtItsPlace) {
    const auto with = [](const std::string& old, const std::string& fresh) {
        std::string json = gltf_json("");
        const std::size_t at = json.find(old);
        EXPECT_NE(at, json.npos) << old;
        return glb(json.replace(at, old.size(), fresh), box_buffer());
    };
    const struct {
        std::string bytes;
        const char* error;
    } cases[] = {
        {with("\"count\": 36", "\"count\": 37"), "/accessors/1: 37 elements are more than its view of 72 bytes has"},
        {with("\"count\": 8", "\"count\": 7"), "/accessors/1: a corner is the vertex 7, there are 7"},
        {with("\"count\": 8", "\"count\": 9007199254740991"), "/accessors/0: 9007199254740991 elements"},
        {with("\"count\": 8", "\"count\": -1"), "/accessors/0/count: expected a whole number"},
        {with("\"count\": 8", "\"sparse\": {}, \"count\": 8"), "/accessors/0/sparse: sparse accessors are not read"},
        {with("5126", "5122"), "/accessors/0: expected positions of three floats"},
        {with("\"byteOffset\": 96", "\"byteOffset\": 97"), "/bufferViews/1: it lies outside of its buffer"},
        {with("\"byteLength\": 168", "\"byteLength\": 169"), "/buffers/0: expected 169 bytes, got 168"},
        {with("\"children\": [0]", "\"children\": [0, 1]"), "/nodes/1: a node has two places"},
        {with("\"children\": [0]", "\"children\": [2]"), "/nodes: something is named that is not among these 2"},
        {with("\"children\": [0]", "\"children\": 0"), "/nodes/1/children: expected a list"},
        {with("[0, 0, 1, 0]", "[0, 0, 1]"), "/nodes/0/rotation: expected 4 numbers"},
        {with("\"2.0\"", "\"1.0\""), "/asset/version: expected glTF 2"},
        {with("\"scenes\"", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"], \"scenes\""),
         "the extension KHR_draco_mesh_compression is not read"},
        {glb(gltf_json(""), box_buffer() + "1234").substr(0, glb(gltf_json(""), box_buffer()).size()),
         "a chunk is longer than the file"},
        {glb(gltf_json("\"uri\": \"data:base64,%%\", "), ""), "/buffers/0/uri: expected base64"},
        {glb(gltf_json("\"uri\": \"no such.bin\", "), ""), "no such.bin"},
        {glb(std::string(4000, '['), ""), "it is no glTF"},
    };
    for (const auto& [bytes, error] : cases) EXPECT_THAT(refusal_of("refused.glb", bytes), HasSubstr(error));
}

}  // namespace
}  // namespace drape
