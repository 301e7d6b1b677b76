// The search for crossings finds the same among all triangles as between two at a time, and ends soon where all cross
// all.
#include "world/triangle_crossings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "drape/scene_reader.h"

namespace drape {
namespace {

using testing::HasSubstr;

/// Triangles of a length up to `size` in a box of side 2, m.
TriangleCrossings::Mesh scattered(std::size_t triangles, double size) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    TriangleCrossings::Mesh mesh;
    for (std::size_t i = 0; i < triangles; ++i) {
        const TriangleCrossings::Point middle{anywhere(random), anywhere(random), anywhere(random)};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            TriangleCrossings::Point at = middle;
            for (double& x : at) x += size * anywhere(random);
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.points.size()));
            mesh.points.push_back(at);
        }
    }
    return mesh;
}

TriangleCrossings::Mesh one_of(const TriangleCrossings::Mesh& mesh, std::size_t triangle) {
    const auto first = mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * triangle);
    return {{first, first + 3}, {0, 1, 2}};
}

TEST(TriangleCrossingsTest, AmongAllAreThoseOfPairs) {
    for (const double size : {0.3, 0.6, 1.5}) {
        const TriangleCrossings::Mesh mesh = scattered(150, size);
        std::vector<bool> crossed(mesh.points.size());
        std::size_t pairs = 0;
        for (std::size_t one = 0; one < 150; ++one)
            for (std::size_t other = 0; other < one; ++other) {
                if (!TriangleCrossings({one_of(mesh, one), one_of(mesh, other)}).any()) continue;
                ++pairs;
                for (std::size_t corner = 0; corner < 3; ++corner)
                    crossed[3 * one + corner] = crossed[3 * other + corner] = true;
            }
        const TriangleCrossings all({mesh});
        EXPECT_GT(pairs, 10u);
        EXPECT_EQ(all.count(), pairs) << size;
        EXPECT_EQ(all.crossed_points(), crossed) << size;
        EXPECT_EQ(all.count([](std::size_t, std::size_t) { return true; }, 7), 7u);
    }
}

/// Cloths are scattered so far that each triangle crosses hundreds: their pairs are counted up to a limit.
TEST(TriangleCrossingsTest, OfClothsScatteredFarAreCountedToALimit) {
    const SceneResult result = read_scene_text(R"({"name": "scattered", "cloths": [
  {"name": "one", "grid": [33, 33], "self_collision": true, "placement": {"jitter": 20}},
  {"name": "two", "grid": [81, 81], "placement": {"jitter": 20}}]})",
                                               "scattered.json", {});
    ASSERT_TRUE(result.scene);
    std::string warnings;
    for (const SceneError& warning : result.warnings) warnings += warning.text() + "\n";
    EXPECT_THAT(warnings, HasSubstr("\"one\" would start through itself by its jitter"));
    EXPECT_THAT(warnings, HasSubstr("start through each other (at least 10000 pairs of triangles cross; "));
}

}  // namespace
}  // namespace drape
