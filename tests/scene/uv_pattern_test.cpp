// A mesh whose texture lays it out flat becomes panels and seams.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "base/output_error.h"
#include "scene/sewing_pattern.h"

namespace drape {
namespace {

constexpr double radius = 0.2, height = 0.6;
constexpr int around = 16, up = 5;

/// A file that is there as long as this is.
class ObjFile {
  public:
    explicit ObjFile(const std::string& text)
        : path_(std::filesystem::temp_directory_path() / fmt::format("uv_pattern_{}.obj", std::size_t(getpid()))) {
        std::ofstream(path_) << text;
    }
    ~ObjFile() { std::filesystem::remove(path_); }
    std::string path() const { return path_.string(); }

  private:
    std::filesystem::path path_;
};

/// A tube about the y axis, whose texture is `islands` strips side by side, in units of 2 m.
std::string tube(int islands, bool mirrored = false) {
    std::string text;
    for (int row = 0; row <= up; ++row)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            text += fmt::format("v {:.12g} {:.12g} {:.12g}\n", radius * std::sin(angle), height * row / up,
                                radius * std::cos(angle));
        }
    const int wide = around / islands;
    const double side = 2 * radius * std::sin(std::numbers::pi / around);
    for (int island = 0; island < islands; ++island)
        for (int row = 0; row <= up; ++row)
            for (int i = 0; i <= wide; ++i)
                text += fmt::format("vt {} {}\n", (mirrored ? -1 : 1) * (side * i / 2 + island), height * row / up / 2);
    for (int island = 0; island < islands; ++island)
        for (int row = 0; row < up; ++row)
            for (int i = 0; i < wide; ++i) {
                const auto corner = [&](int di, int dr) {
                    return fmt::format("{}/{}", (row + dr) * around + (island * wide + i + di) % around + 1,
                                       (island * (up + 1) + row + dr) * (wide + 1) + i + di + 1);
                };
                text += fmt::format("f {} {} {} {}\n", corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
            }
    return text;
}

Json::Value scene_of_mesh(const std::string& text) {
    const ObjFile file(text);
    const PatternResult result = read_uv_pattern(file.path(), {});
    for (const SceneError& error : result.errors) ADD_FAILURE() << error.text();
    EXPECT_NEAR(result.metres_per_unit.value_or(0), 2, 1e-9);
    Json::Value scene;
    std::istringstream(result.scene) >> scene;
    return scene;
}

Vec3 vector_of(const Json::Value& array) { return {array[0].asDouble(), array[1].asDouble(), array[2].asDouble()}; }

/// Returns where a side begins or ends in the world.
Vec3 in_world(const Json::Value& scene, const Json::Value& side, const char* end) {
    for (const Json::Value& cloth : scene["cloths"]) {
        if (cloth["name"] != side["cloth"]) continue;
        const Vec3 origin = vector_of(cloth["placement"]["origin"]), u = vector_of(cloth["placement"]["u"]),
                   v = vector_of(cloth["placement"]["v"]);
        Vec3 place{};
        for (std::size_t k = 0; k < 3; ++k)
            place[k] = origin[k] + side[end][0].asDouble() * u[k] + side[end][1].asDouble() * v[k];
        return place;
    }
    return {};
}

/// Two halves of a tube lie flat through their middles, square to the way to the axis, and are sewn along both sides.
TEST(UvPattern, IslandsBecomePanels) {
    for (const bool mirrored : {false, true}) {
        SCOPED_TRACE(mirrored);
        const Json::Value scene = scene_of_mesh(tube(2, mirrored));
        ASSERT_EQ(scene["cloths"].size(), 2u);
        for (const Json::Value& cloth : scene["cloths"]) {
            const Vec3 origin = vector_of(cloth["placement"]["origin"]), v = vector_of(cloth["placement"]["v"]);
            EXPECT_NEAR(origin[1], height / 2, 1e-5);
            EXPECT_NEAR(origin[2], 0, 1e-5);
            EXPECT_GT(std::abs(origin[0]), radius / 2);
            EXPECT_NEAR(v[1], 1, 1e-5);
        }
        ASSERT_EQ(scene["seams"].size(), 2u);
        for (const Json::Value& seam : scene["seams"]) {
            EXPECT_NE(seam["a"]["cloth"], seam["b"]["cloth"]);
            const Vec3 begin = in_world(scene, seam["a"], "from"), end = in_world(scene, seam["a"], "to");
            EXPECT_NEAR(std::abs(begin[1] - end[1]), height, 1e-5);
            // Both sides go the same way, and begin on the same side of the tube.
            EXPECT_NEAR(in_world(scene, seam["b"], "from")[1], begin[1], 1e-5);
            EXPECT_GT(in_world(scene, seam["b"], "from")[2] * begin[2], 0);
        }
    }
}

/// A tube of one island is sewn to itself.
TEST(UvPattern, APanelMayBeSewnToItself) {
    const Json::Value scene = scene_of_mesh(tube(1));
    ASSERT_EQ(scene["cloths"].size(), 1u);
    ASSERT_EQ(scene["seams"].size(), 1u);
    EXPECT_EQ(scene["seams"][0]["a"]["cloth"], scene["seams"][0]["b"]["cloth"]);
}

/// Two discs on each other, sewn all the way round.
TEST(UvPattern, ASeamThatGoesAllTheWayRoundBecomesTwo) {
    std::string text = "v 0 0.1 0\nv 0 -0.1 0\nvt 0 0\nvt 5 0\n";
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * std::numbers::pi * i / 12;
        text += fmt::format("v {} 0 {}\n", std::cos(angle), std::sin(angle));
    }
    for (int disc = 0; disc < 2; ++disc)
        for (int i = 0; i < 12; ++i) {
            const double angle = 2 * std::numbers::pi * i / 12;
            text += fmt::format("vt {} {}\n", 5 * disc + std::cos(angle), std::sin(angle));
        }
    for (int disc = 0; disc < 2; ++disc)
        for (int i = 0; i < 12; ++i)
            text += fmt::format("f {}/{} {}/{} {}/{}\n", disc + 1, disc + 1, i + 3, 12 * disc + i + 3, (i + 1) % 12 + 3,
                                12 * disc + (i + 1) % 12 + 3);
    const ObjFile file(text);
    const PatternResult result = read_uv_pattern(file.path(), {});
    EXPECT_TRUE(result.errors.empty());
    EXPECT_EQ(result.panels, 2u);
    EXPECT_EQ(result.seams, 2u);
}

TEST(UvPattern, WhatIsWrongIsTold) {
    const auto errors = [](const std::string& text) {
        const ObjFile file(text);
        const PatternResult result = read_uv_pattern(file.path(), {});
        EXPECT_TRUE(result.scene.empty());
        return result.errors.empty() ? "" : result.errors[0].message;
    };
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    EXPECT_EQ(errors(square), "expected triangles that a texture lays out flat, got none with an area on both");
    EXPECT_EQ(errors(square + "f 1/1 2/2 3/3\nf 1/1 2/2 4/4\n"),
              "expected islands of the texture whose triangles lie side by side, got two on the same side of an edge, "
              "at 0, 0");
    const ObjFile file(square + "f 1 2 3\n");
    EXPECT_THROW((void)read_uv_pattern(file.path(), {}), OutputError);
}

}  // namespace
}  // namespace drape
