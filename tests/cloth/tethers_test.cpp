// A free particle is tethered to the right held particles, at the right distances.
#include "cloth/tethers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cloth/cloth_model.h"
#include "support/sheets.h"

namespace drape {
namespace {

constexpr std::array spacing{0.1, 0.05};

TEST(TethersTest, AWholeGridMeasuresTheStraightLineToTheTwoNearestPins) {
    const Grid grid(11, 9);
    const std::vector<Pin> pins = {test::pin_box(0, 0, 0, 0), test::pin_box(10, 0, 10, 2), test::pin_box(0, 8, 1, 8)};
    const auto tethers = find_tethers(grid, spacing, pins, 0.01);
    ASSERT_EQ(tethers.size(), grid.particle_count());
    const glsl::ParticleTethers& one = tethers[grid.particle(7, 6)];
    EXPECT_EQ(one.anchor_a, static_cast<int>(grid.particle(10, 2)));
    EXPECT_FLOAT_EQ(one.length_a, static_cast<float>(1.01 * std::hypot(0.3, 0.2)));
    EXPECT_EQ(one.anchor_b, static_cast<int>(grid.particle(1, 8)));
    EXPECT_FLOAT_EQ(one.length_b, static_cast<float>(1.01 * std::hypot(0.6, 0.1)));
}

TEST(TethersTest, OnePinGivesOneTetherAndNoneGivesNone) {
    const Grid grid(4, 4);
    const auto one = find_tethers(grid, spacing, {test::pin_box(0, 0, 3, 0)}, 0);
    EXPECT_EQ(one[grid.particle(2, 3)].anchor_a, 2);
    EXPECT_EQ(one[grid.particle(2, 3)].anchor_b, -1);
    for (const glsl::ParticleTethers& none : find_tethers(grid, spacing, {}, 0)) {
        EXPECT_EQ(none.anchor_a, -1);
        EXPECT_EQ(none.anchor_b, -1);
    }
}

TEST(TethersTest, PathsGoAroundAHoleAndAreNeverTooShort) {
    const std::array cell{0.1, 0.1};
    const IndexBox hole{{3, 0}, {7, 8}};  // open at the top: the way leads below it
    const Grid grid(11, 11, std::vector<IndexBox>{hole});
    const auto tethers = find_tethers(grid, cell, {test::pin_box(0, 0, 0, 0)}, 0);
    const glsl::ParticleTethers& beyond = tethers[grid.particle(10, 0)];
    EXPECT_EQ(beyond.anchor_a, 0);
    // The way goes round the hole's lower corners: it is never shorter than the taut string, and at most 8.3 % longer.
    const double taut = 0.1 * (2 * std::hypot(3, 8) + 4);
    EXPECT_GE(beyond.length_a, static_cast<float>(taut) - 1e-6f);
    EXPECT_LE(beyond.length_a, static_cast<float>(1.083 * taut));
}

TEST(TethersTest, OutOfReachIsNoTether) {
    const IndexBox gap{{3, 0}, {6, 8}};  // through the whole grid: two pieces
    const Grid grid(9, 9, std::vector<IndexBox>{gap});
    const auto tethers = find_tethers(grid, spacing, {test::pin_box(0, 0, 0, 8)}, 0);
    EXPECT_EQ(tethers[grid.particle(8, 4)].anchor_a, -1);
    EXPECT_EQ(tethers[grid.particle(2, 4)].anchor_a, static_cast<int>(grid.particle(0, 4)));
}

TEST(TethersTest, AModelHasThemWhereTheyAreAskedForAndSaysWhyNot) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 4);
    EXPECT_TRUE(ClothModel(scene, 0).tethers.empty());
    scene.solver.tethers = true;
    const ClothModel loose(scene, 0);
    EXPECT_TRUE(loose.tethers.empty());
    bool said = false;
    for (const SkippedWork& skipped : loose.skipped) said = said || skipped.what == "sheet/tethers";
    EXPECT_TRUE(said);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    EXPECT_EQ(ClothModel(scene, 0).tethers.size(), 25u);
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_EQ(tether_give(scene.cloths[0], scene.gravity), 0);
}

TEST(TethersTest, FollowAShapeOfRest) {
    const Grid grid(3, 2);
    const std::array cell{1.0, 1.0};
    const std::vector<glsl::vec4> scales(6, {1.5f, 1, 2, 2});
    const auto tethers = find_tethers(grid, cell, {test::pin_box(0, 0, 0, 0)}, 0, scales);
    EXPECT_FLOAT_EQ(tethers[2].length_a, 3);
    EXPECT_FLOAT_EQ(tethers[5].length_a, 4) << "no diagonal is shorter";
}

}  // namespace
}  // namespace drape
