// After a cut both sides are consistent, and area and mass are kept, whatever the cut.
#include "cloth/cut_topology.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "cloth/frame_steps.h"
#include "support/cut_checks.h"
#include "support/sheets.h"
#include "twin/cut_twin.h"

namespace drape {
namespace {

Cutter blade(const Vec3& a, const Vec3& b, const Vec3& c) {
    Cutter cutter;
    cutter.triangle = {a, b, c};
    cutter.end = 100;
    return cutter;
}

SceneDescription sheet9(bool shows_crumbs) {
    SceneDescription scene = test::sheet(9, 9, 0.8, 0.8, 4);
    scene.cutters.resize(1);
    scene.cutters[0].crumbs = shows_crumbs;
    return scene;
}

struct Cloth9 {
    explicit Cloth9(bool shows_crumbs = false) : scene(sheet9(shows_crumbs)) {}
    SceneDescription scene;
    SimulationModel model{scene};
    const ClothModel& cloth = model.cloths[0];
    CutTopology topology{cloth};
    CutCounts cut(const Cutter& cutter) {
        return topology.apply(find_cuts(topology, cloth.position, cutter_triangles({cutter}, 0, 0)));
    }
};

TEST(CutTopologyTest, AStraightCutLeavesTwoSidesThatNothingJoins) {
    Cloth9 sheet;
    const double area = sheet.topology.rest_area();
    // A vertical blade goes through x = 0.33, all the way.
    const CutCounts counts = sheet.cut(blade({0.33, 5, -5}, {0.33, -10, -5}, {0.33, -2, 10}));
    EXPECT_EQ(counts.springs, 9u + 2u * 8u) << "one row spring per row, both diagonals per cell";
    EXPECT_EQ(counts.triangles, 16u);
    test::expect_consistent(sheet.topology);
    EXPECT_EQ(test::piece_count(sheet.topology), 2u);
    EXPECT_NEAR(sheet.topology.rest_area(), area, 1e-6 * area);
}

TEST(CutTopologyTest, TheEndOfASlitStaysWhole) {
    Cloth9 sheet;
    // The blade goes from the top edge down to y = -0.37, inside a cell.
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
    EXPECT_EQ(sheet.topology.crumb_count(), 1u);
    test::expect_consistent(sheet.topology);
}

/// Returns the particle that a drawn index hangs on.
std::uint32_t anchor(const CutTopology& topology, std::uint32_t index) {
    const std::size_t count = topology.cloth().grid.particle_count();
    return index < count ? index : topology.vertices()[index - count].particles.x;
}

/// Returns the area at rest, m^2, of the drawn part of each piece, by the piece's number.
std::map<std::size_t, double> drawn_areas(const CutTopology& topology) {
    const auto at = [&](std::uint32_t index) {
        const std::size_t count = topology.cloth().grid.particle_count();
        if (index < count) return std::array{0.1 * (index % 9), 0.1 * (index / 9)};
        const glsl::vec4& material = topology.vertices()[index - count].material;
        return std::array{double(material.x), double(material.y)};
    };
    const std::vector<std::size_t> piece = pieces_of(topology);
    const std::vector<std::uint32_t>& drawn = topology.indices();
    std::map<std::size_t, double> areas;
    for (std::size_t k = 0; k < drawn.size(); k += 3) {
        const auto a = at(drawn[k]), b = at(drawn[k + 1]), c = at(drawn[k + 2]);
        const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
        if (area != 0) areas[piece[anchor(topology, drawn[k])]] += area;
    }
    return areas;
}

TEST(CutTopologyTest, CrumbsAreCountedAndLeftOut) {
    constexpr double four_triangles = 4 * 0.1 * 0.1 / 2;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-0.2, 1.0);
    std::size_t crumbs = 0;
    for (int round = 0; round < 20; ++round) {
        Cloth9 shown(true), hidden;
        for (int k = 0; k < 40; ++k) {
            const Cutter cutter = blade({unit(random), -unit(random), 0.3}, {unit(random), -unit(random), -0.3},
                                        {unit(random), -unit(random), unit(random) - 0.4});
            shown.cut(cutter);
            hidden.cut(cutter);
        }
        std::map<std::size_t, double> kept = drawn_areas(shown.topology);
        const std::size_t pieces = kept.size();
        std::erase_if(kept, [&](const auto& piece) { return piece.second < four_triangles - 1e-9; });
        ASSERT_FALSE(kept.empty());
        const std::map<std::size_t, double> drawn = drawn_areas(hidden.topology);
        ASSERT_EQ(drawn.size(), kept.size());
        for (const auto& [piece, area] : kept) EXPECT_NEAR(drawn.at(piece), area, 1e-7);
        EXPECT_EQ(hidden.topology.crumb_count(), pieces - kept.size());
        EXPECT_EQ(shown.topology.crumb_count(), pieces - kept.size());
        const std::size_t whole = hidden.topology.whole_triangles().size();
        EXPECT_LE(whole, shown.topology.whole_triangles().size());
        crumbs += pieces - kept.size();
    }
    EXPECT_GT(crumbs, 50u);
}

TEST(CutTopologyTest, TheLargestPieceIsNoCrumb) {
    const SimulationModel model(test::sheet(2, 3, 0.1, 0.2, 4));
    CutTopology topology(model.cloths[0]);
    topology.apply(find_cuts(topology, model.cloths[0].position,
                             cutter_triangles({blade({-5, -0.07, -5}, {5, -0.07, -5}, {0, -0.07, 10})}, 0, 0)));
    EXPECT_EQ(test::piece_count(topology), 2u);
    test::expect_consistent(topology);
    EXPECT_EQ(topology.crumb_count(), 1u) << "four triangles in all, so both are small";
    EXPECT_NEAR(topology.rest_area(), 0.02, 1e-9);
    // The lower piece is drawn, its two whole triangles and three parts.
    EXPECT_EQ(topology.whole_triangles().size(), 2u * 3u);
    EXPECT_EQ(topology.indices().size(), (4u + 3u) * 3u);
}

TEST(CutTopologyTest, RandomCutsKeepAreaMassAndConsistency) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-0.2, 1.0);
    for (int round = 0; round < 30; ++round) {
        Cloth9 sheet;
        const double area = sheet.topology.rest_area();
        const std::vector<glsl::vec4> weights = sheet.cloth.position;
        for (int k = 0; k < 40; ++k) {
            sheet.cut(blade({unit(random), -unit(random), 0.3}, {unit(random), -unit(random), -0.3},
                            {unit(random), -unit(random), unit(random) - 0.4}));
            test::expect_consistent(sheet.topology);
            EXPECT_NEAR(sheet.topology.rest_area(), area, 1e-6 * area);
        }
        for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_EQ(sheet.cloth.position[i].w, weights[i].w);
        if (HasFailure()) return;
    }
}

TEST(CutTopologyTest, CutVerticesLieWhereTheCutWas) {
    // At rest both edges lie on the cut line, upright and slanted: x = 0.33 and x = 0.13 - slope * y.
    for (const double slope : {0.0, 0.3, 0.77, 1.4}) {
        Cloth9 sheet;
        const double foot = slope == 0 ? 0.33 : 0.13;
        sheet.cut(blade({foot - slope * 5, 5, -5}, {foot + slope * 10, -10, -5}, {foot + slope * 2, -2, 10}));
        ASSERT_FALSE(sheet.topology.vertices().empty());
        for (const glsl::CutVertex& vertex : sheet.topology.vertices()) {
            const Vec3 at = test::evaluate(vertex, sheet.cloth.position);
            EXPECT_NEAR(at[0] + slope * at[1], foot, 1e-6) << slope;
            EXPECT_NEAR(at[0], double(vertex.material.x), 1e-6);
            EXPECT_NEAR(-at[1], double(vertex.material.y), 1e-6);
        }
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
    // The blade jumps over a thin sheet between two frames, and its prism's sides hit it.
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
