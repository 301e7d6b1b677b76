// Topology after cuts: both sides consistent, area and mass kept, whatever the cut.
#include "cloth/cut_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "cloth/schedule.h"
#include "reference/cut_twin.h"
#include "support/cut_checks.h"
#include "support/sheets.h"

namespace drape {
namespace {

Cutter blade(const Vec3& a, const Vec3& b, const Vec3& c) {
    Cutter cutter;
    cutter.triangle = {a, b, c};
    cutter.end = 100;
    return cutter;
}

struct Cloth9 {
    SceneDescription scene = test::sheet(9, 9, 0.8, 0.8, 4);
    SimulationModel model{scene};
    const ClothModel& cloth = model.cloths[0];
    CutTopology topology{cloth};
    CutCounts cut(const Cutter& cutter) {
        return topology.apply(find_cuts(topology, cloth.position, cutter_triangles({cutter}, 0, 0)));
    }
};

TEST(CutTopologyTest, AStraightCutLeavesTwoSidesThatNothingJoins) {
    Cloth9 sheet;
    const double area = sheet.topology.drawn_rest_area();
    // A vertical blade through x = 0.33, all the way.
    const CutCounts counts = sheet.cut(blade({0.33, 5, -5}, {0.33, -10, -5}, {0.33, -2, 10}));
    EXPECT_EQ(counts.springs, 9u + 2u * 8u) << "one row spring per row, both diagonals per cell";
    EXPECT_EQ(counts.triangles, 16u);
    test::expect_consistent(sheet.topology);
    EXPECT_EQ(test::piece_count(sheet.topology), 2u);
    EXPECT_NEAR(sheet.topology.drawn_rest_area(), area, 1e-6 * area);
}

TEST(CutTopologyTest, TheEndOfASlitStaysWhole) {
    Cloth9 sheet;
    // From the top edge down to y = -0.37, inside a cell.
    const CutCounts counts = sheet.cut(blade({0.33, 1, -1}, {0.33, 1, 1}, {0.33, -0.37, 0}));
    EXPECT_GT(counts.springs, 0u);
    EXPECT_EQ(test::piece_count(sheet.topology), 1u);
    test::expect_consistent(sheet.topology);
    std::size_t whole_with_a_cut_edge = 0;
    const std::vector<std::uint32_t> whole = sheet.topology.whole_triangles();
    for (std::size_t k = 0; k < whole.size(); k += 3)
        whole_with_a_cut_edge += test::cut_edge_count(sheet.topology, &whole[k]) == 1;
    EXPECT_EQ(whole_with_a_cut_edge, 1u) << "the triangle at the slit's very end";
}

TEST(CutTopologyTest, ACutExactlyThroughParticlesIsClean) {
    Cloth9 sheet;
    const float x = sheet.cloth.position[4].x;
    sheet.cut(blade({double(x), 5, -5}, {double(x), -10, -5}, {double(x), -2, 10}));
    EXPECT_EQ(test::piece_count(sheet.topology), 2u);
    test::expect_consistent(sheet.topology);
}

TEST(CutTopologyTest, ACutterThatMeetsNothingChangesNothing) {
    Cloth9 sheet;
    const std::vector<std::uint32_t> before = sheet.topology.indices();
    EXPECT_FALSE(sheet.cut(blade({5, 5, 5}, {6, 5, 5}, {5, 6, 5})).any());
    EXPECT_EQ(sheet.topology.indices(), before);
    EXPECT_TRUE(sheet.topology.vertices().empty());
}

TEST(CutTopologyTest, ASingleParticleCanBeCutFree) {
    Cloth9 sheet;
    sheet.cut(blade({-0.1, -0.05, -1}, {0.2, 0.1, 0}, {-0.1, -0.05, 1}));  // across the corner (0, 0)
    sheet.cut(blade({0.05, 0.1, -1}, {-0.05, -0.2, 0}, {0.05, 0.1, 1}));
    sheet.cut(blade({-0.2, -0.03, 0}, {0.2, -0.03, -1}, {0.2, -0.03, 1}));
    sheet.cut(blade({0.03, 0.2, 0}, {0.03, -0.2, -1}, {0.03, -0.2, 1}));
    EXPECT_EQ(test::piece_count(sheet.topology), 2u);
    test::expect_consistent(sheet.topology);
}

TEST(CutTopologyTest, RandomCutsKeepAreaMassAndConsistency) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.2, 1.0);
    for (int round = 0; round < 30; ++round) {
        Cloth9 sheet;
        const double area = sheet.topology.drawn_rest_area();
        const std::vector<glsl::vec4> weights = sheet.cloth.position;
        for (int k = 0; k < 40; ++k) {
            sheet.cut(blade({unit(random), -unit(random), 0.3}, {unit(random), -unit(random), -0.3},
                            {unit(random), -unit(random), unit(random) - 0.4}));
            test::expect_consistent(sheet.topology);
            EXPECT_NEAR(sheet.topology.drawn_rest_area(), area, 1e-6 * area);
        }
        for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_EQ(sheet.cloth.position[i].w, weights[i].w);
        if (HasFailure()) return;
    }
}

TEST(CutTopologyTest, CutVerticesLieWhereTheCutWas) {
    Cloth9 sheet;
    sheet.cut(blade({0.33, 5, -5}, {0.33, -10, -5}, {0.33, -2, 10}));
    ASSERT_FALSE(sheet.topology.vertices().empty());
    for (const glsl::CutVertex& vertex : sheet.topology.vertices()) {
        const Vec3 at = test::evaluate(vertex, sheet.cloth.position);
        EXPECT_NEAR(at[0], 0.33, 1e-6) << "at rest both edges are the cut line";
        EXPECT_NEAR(at[0], double(vertex.material.x), 1e-6);
        EXPECT_NEAR(-at[1], double(vertex.material.y), 1e-6);
    }
}

TEST(CutterSweepTest, AMovingBladeSweepsThePrismsSurface) {
    Cutter cutter = blade({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    cutter.begin = 0.5;
    cutter.end = 1.0;
    cutter.path.keys = {{0, {0, 0, 0}, {}}, {2, {0, 0, 2}, {}}};
    EXPECT_FALSE(cutters_active({cutter}, 0.0, 0.4));
    EXPECT_TRUE(cutters_active({cutter}, 0.45, 0.5));
    const auto triangles = cutter_triangles({cutter}, 0.6, 0.7);
    ASSERT_EQ(triangles.size(), 8u);
    for (const glsl::CutterTriangle& t : triangles) EXPECT_EQ(t.a.w, 1.0f);
    const auto idle = cutter_triangles({cutter}, 0.0, 0.1);
    for (const glsl::CutterTriangle& t : idle) EXPECT_EQ(t.a.w, 0.0f);
    // A thin sheet that the blade jumps over between two frames is hit by the sides.
    SceneDescription scene = test::sheet(3, 3, 0.2, 0.2, 4);
    scene.cloths[0].placement = {{0.1, 0.1, 0.4}, {1, 0, 0}, {0, 0.8, 0.6}};
    const ClothModel model(scene, 0);
    cutter.begin = 0;
    cutter.triangle = {{{0.19, -1, -0.2}, {0.19, 2, -0.2}, {0.19, 0, -0.1}}};
    const CutFindings found = find_cuts(CutTopology(model), model.position, cutter_triangles({cutter}, 0.1, 1.0));
    double crossed = 0;
    for (const glsl::vec4& f : found.fractions) crossed += f.x >= 0;
    EXPECT_EQ(crossed, 3) << "one row spring in each of three rows";
}

}  // namespace
}  // namespace drape
