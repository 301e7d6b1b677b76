#include "world/gust.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drape {
namespace {

TEST(Gust, PhasesFollowThePublishedHash) {
    // splitmix64's known first output for state 0 is e220a8397b1dcdaf. splitmix64(x) here adds the increment itself, so
    // seed + k = 0 would give it; for seed 0, k = 1 the generator has state 1: 910a2dec89025cc1.
    const double expected = 2 * std::numbers::pi * (static_cast<double>(0x910a2dec89025cc1u >> 11) * 0x1p-53);
    EXPECT_EQ(gust_phases(0)[0], expected);
    EXPECT_EQ(gust_phases(1)[0], gust_phases(0)[1]);  // seed + k only
    EXPECT_NE(gust_phases(0), gust_phases(1));
    for (std::uint32_t seed = 0; seed < 1000; ++seed)
        for (const double phase : gust_phases(seed)) {
            ASSERT_GE(phase, 0.0);
            ASSERT_LT(phase, 2 * std::numbers::pi);
        }
}

TEST(Gust, FollowsTheFormulaOfTheSchema) {
    const Gust gust{2.0, 1.5, 7};
    const auto p = gust_phases(7);
    for (const double t : {0.0, 0.3, 1.5, 12.25}) {
        const double turn = 2 * std::numbers::pi * t / 1.5;
        const double expected =
            2.0 * (std::sin(turn + p[0]) + 0.5 * std::sin(2.3 * turn + p[1]) + 0.25 * std::sin(5.1 * turn + p[2])) /
            1.75;
        EXPECT_NEAR(gust_speed(gust, t), expected, 1e-12);
    }
}

TEST(Gust, StaysWithinItsAmplitudeAndComesNearIt) {
    const Gust gust{3.0, 0.7, 42};
    double largest = 0.0;
    for (double t = 0; t < 200; t += 0.01) largest = std::max(largest, std::abs(gust_speed(gust, t)));
    EXPECT_LE(largest, 3.0);
    EXPECT_GT(largest, 2.5);
}

TEST(Wind, GustBlowsAlongTheVelocity) {
    Wind wind;
    wind.velocity = {3, 0, 4};
    EXPECT_EQ(wind_velocity(wind, 1.0), wind.velocity);  // no gust: exact
    wind.gust = {2.0, 1.5, 7};
    const double extra = gust_speed(wind.gust, 0.4);
    ASSERT_GT(std::abs(extra), 0.01);
    const Vec3 velocity = wind_velocity(wind, 0.4);
    EXPECT_NEAR(velocity[0], 3 + 0.6 * extra, 1e-14);
    EXPECT_EQ(velocity[1], 0.0);
    EXPECT_NEAR(velocity[2], 4 + 0.8 * extra, 1e-14);
}

TEST(Wind, CalmAirHasNoGust) {
    Wind wind;
    wind.gust = {2.0, 1.5, 7};
    EXPECT_EQ(wind_velocity(wind, 0.4), (Vec3{0, 0, 0}));
}

}  // namespace
}  // namespace drape
