// The direction table gives every spring exactly once, and no particle twice in a pass.
#include "cloth/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "twin/kernels.h"

namespace drape {
namespace {

using Spring = std::tuple<int, int, int, int>;  // both particles, smaller first

Spring spring_between(glsl::ivec2 a, glsl::ivec2 b) {
    if (std::tie(b.y, b.x) < std::tie(a.y, a.x)) std::swap(a, b);
    return {a.x, a.y, b.x, b.y};
}

/// All springs of a grid, written down without the table: neighbours right and below, and both diagonals of a cell.
std::set<Spring> expected_springs(glsl::ivec2 grid) {
    std::set<Spring> springs;
    for (int y = 0; y < grid.y; ++y)
        for (int x = 0; x < grid.x; ++x) {
            if (x + 1 < grid.x) springs.insert(spring_between({x, y}, {x + 1, y}));
            if (y + 1 < grid.y) springs.insert(spring_between({x, y}, {x, y + 1}));
            if (x + 1 < grid.x && y + 1 < grid.y) {
                springs.insert(spring_between({x, y}, {x + 1, y + 1}));
                springs.insert(spring_between({x + 1, y}, {x, y + 1}));
            }
        }
    return springs;
}

class DirectionTable : public testing::TestWithParam<glsl::ivec2> {};

TEST_P(DirectionTable, HoldsEverySpringOnceAndNoParticleTwiceInAPass) {
    const glsl::ivec2 grid = GetParam();
    std::map<Spring, int> seen;
    for (const SpringPass& pass : spring_passes(grid)) {
        const SpringDirection& direction = spring_directions[static_cast<std::size_t>(pass.direction)];
        std::set<std::pair<int, int>> particles;
        for (int y = 0; y < pass.pair_count.y; ++y)
            for (int x = 0; x < pass.pair_count.x; ++x) {
                const glsl::ivec2 first =
                    glsl::spring_owner({x, y}, direction.offset, direction.parity_axis, pass.parity);
                const glsl::ivec2 second{first.x + direction.offset.x, first.y + direction.offset.y};
                for (const glsl::ivec2 p : {first, second}) {
                    ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x < grid.x && p.y < grid.y) << direction.name;
                    ASSERT_TRUE(particles.insert({p.x, p.y}).second)
                        << "particle " << p.x << "," << p.y << " twice in " << direction.name << pass.parity;
                }
                ++seen[spring_between(first, second)];
            }
    }
    const std::set<Spring> expected = expected_springs(grid);
    EXPECT_EQ(seen.size(), expected.size());
    for (const Spring& spring : expected) EXPECT_EQ(seen[spring], 1);
}

TEST_P(DirectionTable, HoldsEveryBendingElementOnceAndNoParticleTwiceInAPass) {
    const glsl::ivec2 grid = GetParam();
    std::map<std::tuple<int, int, int>, int> seen;  // axis, middle
    for (const BendPass& pass : bend_passes(grid)) {
        const glsl::ivec2 offset = bend_axes[static_cast<std::size_t>(pass.axis)].offset;
        std::set<std::pair<int, int>> particles;
        for (int y = 0; y < pass.element_count.y; ++y)
            for (int x = 0; x < pass.element_count.x; ++x) {
                const glsl::ivec2 middle = glsl::bend_middle({x, y}, offset, pass.colour);
                for (int k = -1; k <= 1; ++k) {
                    const glsl::ivec2 p{middle.x + k * offset.x, middle.y + k * offset.y};
                    ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x < grid.x && p.y < grid.y);
                    ASSERT_TRUE(particles.insert({p.x, p.y}).second) << "particle " << p.x << "," << p.y << " twice";
                }
                ++seen[{pass.axis, middle.x, middle.y}];
            }
    }
    const auto inner = [](int count) { return static_cast<std::size_t>(std::max(count - 2, 0)); };
    EXPECT_EQ(seen.size(),
              inner(grid.x) * static_cast<std::size_t>(grid.y) + inner(grid.y) * static_cast<std::size_t>(grid.x));
    for (const auto& [element, count] : seen) EXPECT_EQ(count, 1);
}

TEST_P(DirectionTable, HoldsEveryCellsTwistOnceAndNoParticleTwiceInAPass) {
    const glsl::ivec2 grid = GetParam();
    std::map<std::pair<int, int>, int> seen;  // upper left corners
    for (const TwistPass& pass : twist_passes(grid)) {
        std::set<std::pair<int, int>> particles;
        for (int y = 0; y < pass.element_count.y; ++y)
            for (int x = 0; x < pass.element_count.x; ++x) {
                const glsl::ivec2 corner = glsl::twist_corner({x, y}, pass.first);
                for (int k = 0; k < 4; ++k) {
                    const glsl::ivec2 p{corner.x + k % 2, corner.y + k / 2};
                    ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x < grid.x && p.y < grid.y);
                    ASSERT_TRUE(particles.insert({p.x, p.y}).second) << "particle " << p.x << "," << p.y << " twice";
                }
                ++seen[{corner.x, corner.y}];
            }
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>((grid.x - 1) * (grid.y - 1)));
    for (const auto& [cell, count] : seen) EXPECT_EQ(count, 1);
}

INSTANTIATE_TEST_SUITE_P(Grids, DirectionTable,
                         testing::Values(glsl::ivec2{2, 2}, glsl::ivec2{2, 7}, glsl::ivec2{8, 2}, glsl::ivec2{3, 3},
                                         glsl::ivec2{9, 5}, glsl::ivec2{8, 8}, glsl::ivec2{16, 9}, glsl::ivec2{33, 64},
                                         glsl::ivec2{65, 3}));

TEST(DirectionTableTest, NeighboursAreTheSpringsOfTheTableFromBothEnds) {
    std::set<std::tuple<int, int, int, int>> expected;  // offset, direction, whether this particle is the first
    for (int direction = 0; direction < 4; ++direction) {
        const glsl::ivec2 offset = spring_directions[static_cast<std::size_t>(direction)].offset;
        expected.insert({offset.x, offset.y, direction, 1});
        expected.insert({-offset.x, -offset.y, direction, 0});
    }
    std::set<std::tuple<int, int, int, int>> found;
    int place = -9;
    for (int k = 0; k < glsl::neighbour_count; ++k) {
        const glsl::ivec4 around = glsl::neighbour(k);
        found.insert({around.x, around.y, around.z, around.w});
        EXPECT_GT(3 * around.y + around.x, place) << "row by row, left to right";
        place = 3 * around.y + around.x;
    }
    EXPECT_EQ(found, expected);
}

TEST(DirectionTableTest, OddPassesOfTwoColumnGridsAreEmpty) {
    EXPECT_TRUE(spring_pass(0, 1, {2, 5}).empty());
    EXPECT_FALSE(spring_pass(0, 0, {2, 5}).empty());
    EXPECT_TRUE(spring_pass(1, 1, {5, 2}).empty());
    EXPECT_TRUE(spring_pass(2, 1, {5, 2}).empty());
}

}  // namespace
}  // namespace drape
