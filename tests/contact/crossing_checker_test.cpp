// The checker that judges runs is tried on known cases, and against the checker of the program's own oracle.
#include "crossing_checker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "world/triangle_crossings.h"

namespace drape::test {
namespace {

FloatMesh triangle(FloatPoint a, FloatPoint b, FloatPoint c) { return {{a, b, c}, {{0, 1, 2}}}; }

const FloatMesh wall = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});

std::pair<std::size_t, std::size_t> found(const FloatMesh& one, const FloatMesh& other) {
    const Crossings crossings = find_crossings({one, other});
    return {crossings.pairs.size(), crossings.touching};
}
using Found = std::pair<std::size_t, std::size_t>;

TEST(CrossingCheckerTest, KnowsCrossingFromTouchingAndApart) {
    EXPECT_EQ(found(wall, triangle({0.25F, 0.25F, -1}, {0.25F, 0.5F, 1}, {5, 5, 1})), (Found{1, 0}));
    EXPECT_EQ(found(wall, triangle({0.25F, 0.25F, 0.01F}, {0.25F, 0.5F, 1}, {5, 5, 1})), (Found{0, 0}));
    // A corner lies on the face; another one is lifted off it by a rounding, and one goes as far through.
    EXPECT_EQ(found(wall, triangle({0.25F, 0.25F, 0}, {0.25F, 0.5F, 1}, {5, 5, 1})), (Found{0, 1}));
    EXPECT_EQ(found(wall, triangle({0.25F, 0.25F, 1e-38F}, {0.25F, 0.5F, 1}, {5, 5, 1})), (Found{0, 0}));
    EXPECT_EQ(found(wall, triangle({0.25F, 0.25F, -1e-38F}, {0.25F, 0.5F, 1}, {5, 5, 1})), (Found{1, 0}));
    // An edge goes through an edge.
    EXPECT_EQ(found(wall, triangle({0.5F, 0, -1}, {0.5F, 0, 1}, {0.5F, -5, 0})), (Found{0, 1}));
}

TEST(CrossingCheckerTest, WhatSharesACornerCrossesByTheEdgeAcross) {
    const auto with = [](FloatPoint p, FloatPoint q) {
        return find_crossings({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, p, q}, {{0, 1, 2}, {0, 3, 4}}}}).pairs.size();
    };
    EXPECT_EQ(with({0.2F, 0.2F, -1}, {0.3F, 0.2F, 1}), 1u);
    EXPECT_EQ(with({-0.2F, -0.2F, -1}, {-0.3F, -0.2F, 1}), 0u);
    // Two triangles that share an edge do not cross, however they are folded.
    EXPECT_EQ(
        find_crossings({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3F, 0.3F, 1e-6F}}, {{0, 1, 2}, {0, 1, 3}}}}).pairs.size(),
        0u);
}

/// Whole numbers have exact volumes, many of which are 0.
TEST(CrossingCheckerTest, SidesAreExact) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int64_t> small(-3, 3);
    int flat = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::array<std::array<std::int64_t, 3>, 4> whole{};
        std::array<FloatPoint, 4> at{};
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                // A third of them are far apart in size, where plain doubles round the difference.
                whole[i][k] = small(random) * (trial % 3 == 0 && k == 0 ? 1000003 : 1);
                at[i][k] = std::ldexp(static_cast<float>(whole[i][k]), trial % 3 == 0 && k == 1 ? -60 : 0);
            }
        const auto from = [&](std::size_t i, std::size_t k) { return whole[i][k] - whole[3][k]; };
        std::int64_t volume = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
            volume += from(0, k) * (from(1, l) * from(2, m) - from(1, m) * from(2, l));
        }
        flat += volume == 0 ? 1 : 0;
        ASSERT_EQ(side_of(at[0], at[1], at[2], at[3]), (volume > 0) - (volume < 0)) << trial;
    }
    EXPECT_GT(flat, 500);
}

/// Far from the origin the volume of small tetrahedra is less than what doubles round. It is u . (e x f), u the way
/// from d to a, e and f those from a to b and c.
TEST(CrossingCheckerTest, SidesOfWhatIsFarAndSmallAreExact) {
    std::mt19937 random(5);
    std::uniform_int_distribution<std::int64_t> small(-4, 4);
    constexpr std::int64_t far = 1 << 23;
    int thin = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::array<std::int64_t, 3> e{}, f{}, u{};
        std::array<FloatPoint, 4> at{};
        for (std::size_t k = 0; k < 3; ++k) {
            e[k] = small(random), f[k] = small(random), u[k] = far + small(random);
            at[0][k] = static_cast<float>(u[k]);
            at[1][k] = static_cast<float>(u[k] + e[k]);
            at[2][k] = static_cast<float>(u[k] + f[k]);
        }
        std::int64_t volume = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
            volume += u[k] * (e[l] * f[m] - e[m] * f[l]);
        }
        thin += volume != 0 && std::abs(volume) < 1000 ? 1 : 0;
        ASSERT_EQ(side_of(at[0], at[1], at[2], at[3]), (volume > 0) - (volume < 0)) << trial;
    }
    EXPECT_GT(thin, 500);
}

/// The checker counts as many crossings as the oracle in sheets of random folds, some of which go through each other.
TEST(CrossingCheckerTest, CountsWhatTheOracleCounts) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    std::size_t most = 0;
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<FloatMesh> meshes(2);
        std::vector<TriangleCrossings::Mesh> others(2);
        const float wild = 0.02F * static_cast<float>(trial % 10);
        for (std::size_t sheet = 0; sheet < 2; ++sheet) {
            constexpr std::uint32_t n = 9;
            for (std::uint32_t i = 0; i < n * n; ++i) {
                const std::uint32_t column = i % n, row = i / n;
                const float u = static_cast<float>(column) / (n - 1), v = static_cast<float>(row) / (n - 1);
                meshes[sheet].points.push_back({u + wild * anywhere(random),
                                                0.3F * static_cast<float>(sheet) + wild * anywhere(random),
                                                v + wild * anywhere(random)});
                const FloatPoint& p = meshes[sheet].points.back();
                others[sheet].points.push_back({double{p[0]}, double{p[1]}, double{p[2]}});
                if (column + 1 == n || row + 1 == n) continue;
                meshes[sheet].triangles.push_back({i, i + 1, i + n});
                meshes[sheet].triangles.push_back({i + 1, i + n + 1, i + n});
                others[sheet].indices.insert(others[sheet].indices.end(), {i, i + 1, i + n, i + 1, i + n + 1, i + n});
            }
        }
        const Crossings here = find_crossings(meshes);
        ASSERT_EQ(here.pairs.size(), TriangleCrossings(others).count()) << trial;
        most = std::max(most, here.pairs.size());
    }
    EXPECT_GT(most, 100u);
}

}  // namespace
}  // namespace drape::test
