// The fewest substeps that keep a limit are found, and nothing is measured twice or for nothing.
#include <gtest/gtest.h>

#include "bench/claims.h"

namespace drape::bench {
namespace {

/// Returns the counts measured beyond the sweep's until nothing is left, where `fewest` and more keep the limit.
std::vector<std::uint32_t> measured(std::vector<std::uint32_t> sweep, std::uint32_t fewest) {
    std::vector<SweepPoint> points;
    for (const std::uint32_t count : sweep) points.push_back({count, count >= fewest});
    std::vector<std::uint32_t> more;
    while (const auto next = next_count(points)) {
        more.push_back(*next);
        points.push_back({*next, *next >= fewest});
    }
    return more;
}

TEST(BisectionTest, FindsTheFewest) {
    EXPECT_EQ(measured({5, 10, 20, 40}, 22), (std::vector<std::uint32_t>{30, 25, 22, 21}));
    EXPECT_EQ(measured({4, 8}, 2), (std::vector<std::uint32_t>{2, 1})) << "below the sweep too";
    EXPECT_EQ(measured({4, 8}, 1), (std::vector<std::uint32_t>{2, 1}));
}

TEST(BisectionTest, EndsWithinTwoPerCent) {
    EXPECT_EQ(measured({500, 1000}, 760), (std::vector<std::uint32_t>{750, 875, 812, 781, 765}));
}

TEST(BisectionTest, MeasuresNothingWhereNothingKeepsTheLimitOrNeighboursDecide) {
    EXPECT_FALSE(next_count({}));
    EXPECT_TRUE(measured({5, 10}, 11).empty());
    EXPECT_TRUE(measured({1, 2}, 2).empty());
    EXPECT_TRUE(measured({1, 2}, 1).empty());
}

TEST(BisectionTest, GoesByTheFirstThatKeepsItThoughLaterOnesMayNot) {
    EXPECT_EQ(next_count({{40, false}, {10, false}, {20, true}}), 15u);
}

}  // namespace
}  // namespace drape::bench
