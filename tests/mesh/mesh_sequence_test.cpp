#include "mesh/mesh_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/vectors.h"
#include "mesh/mesh_error.h"
#include "mesh/sequence_file.h"
#include "support/meshes.h"

namespace drape {
namespace {

namespace fs = std::filesystem;
using Poses = std::vector<std::vector<Vec3>>;

TEST(MeshSequenceTest, VerticesMoveStraightBetweenPoses) {
    const Mesh mesh =
        test::deforming_mesh(test::box_mesh({0.1, 0.2, 0.3}), {}, 3, 24, [](const Vec3& at, std::size_t k) {
            return Vec3{at[0] + 0.5 * static_cast<double>(k * k), at[1], at[2]};
        });
    const MeshSequence& sequence = *mesh.sequence;
    ASSERT_EQ(sequence.count(), 3u);
    // The box about all poses reaches from -0.1 to 2.1 along x.
    EXPECT_NEAR(mesh.shape->middle()[0], 1, 1e-6);
    EXPECT_NEAR(mesh.shape->half_extents()[0], 1.1, 1e-6);
    EXPECT_NEAR(mesh.shape->half_extents()[2], 0.3, 1e-6);
    const auto x_of = [&](double pose) { return sequence.at(pose)->vertices()[0][0] + mesh.shape->middle()[0]; };
    const double first = x_of(0);
    EXPECT_NEAR(x_of(0.25) - first, 0.125, 1e-6);
    EXPECT_NEAR(x_of(1.5) - first, 1.25, 1e-6);
    EXPECT_NEAR(x_of(2.5) - first, 1, 1e-6) << "behind the last pose, towards the first";
    EXPECT_NEAR(sequence.farthest(0.5, 2), 1.75, 1e-6);
    EXPECT_NEAR(sequence.farthest_off_middle(0, 1, 2), 0.5, 1e-6);
    EXPECT_EQ(sequence.at(1.5), sequence.at(1.5)) << "the last ones are kept";
    EXPECT_EQ(sequence.at(1.5)->half_extents(), mesh.shape->half_extents());
}

std::string text_of(const auto& make) {
    try {
        make();
    } catch (const MeshError& error) {
        return error.what();
    }
    return "";
}

TEST(MeshSequenceTest, PosesThatAreNoBody) {
    const auto scaled = [](double last) {
        return text_of([&] {
            test::deforming_mesh(test::box_mesh({0.1, 0.2, 0.3}), {}, 3, 24, [&](const Vec3& at, std::size_t k) {
                return Vec3{at[0], k == 2 ? last * at[1] : at[1], at[2]};
            });
        });
    };
    EXPECT_EQ(scaled(0.5), "");
    EXPECT_EQ(scaled(-1),
              "expected poses in which the surface bounds a body as in the mesh, in pose 2 it is inside out");
    EXPECT_EQ(scaled(0),
              "expected poses in which the surface bounds a body as in the mesh, in pose 2 it bounds nothing");
    test::Triangles cut = test::box_mesh({0.1, 0.2, 0.3});
    cut.vertices.push_back(cut.vertices[7]);
    cut.triangles[11] = {4, 8, 6};
    std::size_t calls = 0;
    EXPECT_EQ(text_of([&] {
                  test::deforming_mesh(cut, {}, 1, 24, [&](const Vec3& at, std::size_t) {
                      return ++calls == 9 ? plus(at, {0.01, 0, 0}) : at;
                  });
              }),
              "expected vertices in one place of the mesh to stay together, 7 and 8 part in pose 0");
}

void write_bytes(std::ofstream& file, const auto& value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_vertices(std::ofstream& file, const Poses& poses) {
    for (const auto& pose : poses)
        for (const Vec3& at : pose)
            for (const double x : at) write_bytes(file, static_cast<float>(x));
}

std::string cache_file(const Poses& poses, const std::string& name) {
    std::string path = (fs::path(testing::TempDir()) / name).string();
    std::ofstream file(path, std::ios::binary);
    file.write("POINTCACHE2", 12);
    for (const std::int32_t number : {1, static_cast<std::int32_t>(poses[0].size())}) write_bytes(file, number);
    for (const float number : {0.0f, 1.0f}) write_bytes(file, number);
    write_bytes(file, static_cast<std::int32_t>(poses.size()));
    write_vertices(file, poses);
    return path;
}

std::string array_file(const Poses& poses, const std::string& name) {
    std::string path = (fs::path(testing::TempDir()) / name).string();
    std::ofstream file(path, std::ios::binary);
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(poses.size()) + ", " +
                         std::to_string(poses[0].size()) + ", 3), }";
    header.resize(117, ' ');
    header += '\n';
    file.write("\x93NUMPY\x01\x00", 8);
    write_bytes(file, static_cast<std::uint16_t>(header.size()));
    file << header;
    write_vertices(file, poses);
    return path;
}

class MeshSequenceFileTest : public testing::Test {
  protected:
    MeshSequenceFileTest() {
        for (int k = 0; k < 3; ++k) {
            test::Triangles pose = body;
            test::shift(pose, {0.125 * k, 0.25 * k * k, 0});
            poses.push_back(pose.vertices);
        }
    }
    std::string error_of(const std::string& frames) const {
        return text_of([&] { read_sequence(rest, frames, 1, {}); });
    }

    test::Triangles body = test::box_mesh({0.5, 0.25, 0.125});
    std::string rest = test::obj_file(body, "sequence_rest.obj");
    Poses poses;
};

TEST_F(MeshSequenceFileTest, EveryKindOfFile) {
    const fs::path folder = fs::path(testing::TempDir()) / "sequence of files";
    fs::create_directories(folder);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        const std::string name = "sequence of files/body_00" + std::to_string(k + 8) + ".obj";
        if (k + 8 < 10) test::obj_file({poses[k], body.triangles}, name);
    }
    test::obj_file({poses[2], body.triangles}, "sequence of files/body_010.obj");
    for (const std::string& frames :
         {cache_file(poses, "sequence.pc2"), array_file(poses, "sequence.npy"), (folder / "body_###.obj").string()}) {
        const auto sequence = read_sequence(rest, frames, 2, {});
        ASSERT_EQ(sequence->count(), 3u) << frames;
        for (std::size_t k = 0; k < 3; ++k) {
            // The vertices have an order of their own: the highest one tells.
            double highest = -1;
            for (const Vec3& at : sequence->at(static_cast<double>(k))->vertices()) highest = std::max(highest, at[1]);
            EXPECT_NEAR(highest + sequence->form()->middle()[1], 2 * (0.25 + 0.25 * double(k * k)), 1e-6) << frames;
        }
    }
    EXPECT_EQ(read_sequence(rest, cache_file(poses, "sequence.pc2"), 2, {})->form()->shell(), 0);
}

TEST_F(MeshSequenceFileTest, WhatIsWrongIsSaid) {
    const std::string folder = testing::TempDir();
    Poses other = poses;
    for (auto& pose : other) pose.pop_back();
    EXPECT_EQ(error_of(cache_file(other, "fewer.pc2")),
              "cannot read '" + folder + "fewer.pc2': the mesh has 8 vertices, and it has 7");
    EXPECT_EQ(error_of(array_file(other, "fewer.npy")),
              "cannot read '" + folder +
                  "fewer.npy': the mesh needs float32 or float64 (poses, 8, 3), and it has float32 (3, 7, 3)");
    other = poses;
    other[1][3][2] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(error_of(array_file(other, "nan.npy")),
              "cannot read '" + folder + "nan.npy': coordinates must be finite, vertex 3 of pose 1 has nan");
    const std::string shorter = cache_file(poses, "short.pc2");
    fs::resize_file(shorter, 32 + 12 * 8 * 3 - 1);
    EXPECT_EQ(error_of(shorter), "cannot read '" + shorter + "': it ends too early");
    test::obj_file({poses[0], body.triangles}, "gap_1.obj");
    const std::string last = test::obj_file({poses[0], body.triangles}, "gap_3.obj");
    EXPECT_EQ(error_of(folder + "gap_#.obj"),
              "cannot read '" + folder + "gap_#.obj': number 2 is missing before " + last);
    EXPECT_EQ(error_of(folder + "gap.obj"),
              "cannot read '" + folder +
                  "gap.obj': one run of # must stand in its name for the digits of the files' numbers");
    EXPECT_EQ(error_of(folder + "no_such_#.obj"),
              "cannot read '" + folder + "no_such_#.obj': there is no such file, with digits for the #");
    EXPECT_EQ(error_of(folder + "poses.txt"),
              "cannot read '" + folder + "poses.txt': poses are read from .npy, .npz, .pc2 and .obj");
    EXPECT_EQ(text_of([&] { read_sequence(folder + "body.stl", cache_file(poses, "sequence.pc2"), 1, {}); }),
              "expected an OBJ file, whose vertices have numbers, beside poses, got " + folder + "body.stl");
    std::ofstream(folder + "bad_face.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
    EXPECT_EQ(text_of([&] { read_sequence(folder + "bad_face.obj", cache_file(poses, "sequence.pc2"), 1, {}); }),
              "cannot read '" + folder + "bad_face.obj': line 4 is no face of vertices that are there");
    std::ofstream(folder + "far.obj") << "v 0 0 0\nv 1e200 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(text_of([&] { read_sequence(folder + "far.obj", cache_file(poses, "sequence.pc2"), 1, {}); }),
              "expected finite coordinates, " + folder + "far.obj has 1e+200");
}

}  // namespace
}  // namespace drape
