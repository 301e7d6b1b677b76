#include "world/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace drape {
namespace {

constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

Vec3 turned(const std::array<double, 9>& r, const Vec3& x) {
    return {r[0] * x[0] + r[1] * x[1] + r[2] * x[2], r[3] * x[0] + r[4] * x[1] + r[5] * x[2],
            r[6] * x[0] + r[7] * x[1] + r[8] * x[2]};
}

double translation_x(const MotionPath& path, double time) { return motion_at(path, time).translation[0]; }

// Times are uneven on purpose.
const MotionPath uneven{{{0.0, {0, 0, 0}, {}}, {1.0, {2, 0, 0}, {}}, {4.0, {3, 0, 0}, {}}, {5.0, {-1, 0, 0}, {}}}};

TEST(Motion, EmptyPathIsExactlyTheIdentity) { EXPECT_EQ(motion_at({}, 3.0), RigidTransform{}); }

TEST(Motion, HoldsItsEnds) {
    EXPECT_EQ(translation_x(uneven, -100.0), 0.0);
    EXPECT_EQ(translation_x(uneven, 100.0), -1.0);
    const MotionPath single{{{2.0, {1, 2, 3}, {0, 90, 0}}}};
    for (const double time : {0.0, 2.0, 9.0}) {
        EXPECT_EQ(motion_at(single, time).translation, (Vec3{1, 2, 3}));
        EXPECT_EQ(motion_at(single, time).rotation, rotation_matrix({0, 90, 0}));
    }
}

TEST(Motion, PassesExactlyThroughItsKeys) {
    for (const MotionKey& key : uneven.keys) EXPECT_EQ(translation_x(uneven, key.time), key.translate[0]);
}

TEST(Motion, InterpolatesAsStated) {
    // The first segment has p 0 -> 2 in 1 s, slopes 0 and (3 - 0) / (4 - 0) = 0.75; cubic Hermite at s = 0.5: (0 + 2) /
    // 2 + 1 * (0 - 0.75) / 8.
    EXPECT_DOUBLE_EQ(translation_x(uneven, 0.5), 1.0 - 0.75 / 8);
    // The second one has 2 -> 3 in 3 s, slopes 0.75 and 0, since the way turns round at 3.
    EXPECT_DOUBLE_EQ(translation_x(uneven, 2.5), 2.5 + 3.0 * 0.75 / 8);
    // 0, 1, 41 at 0, 1, 2 s: the slope 41 / 2 at 1 s is limited to three times 1.
    const MotionPath sudden{{{0.0, {0, 0, 0}, {}}, {1.0, {1, 0, 0}, {}}, {2.0, {41, 0, 0}, {}}}};
    EXPECT_DOUBLE_EQ(translation_x(sudden, 0.5), 0.5 - 3.0 / 8);
    // Two keys have slopes of zero, so smoothstep; s = 0.25 gives 5/32.
    const MotionPath pair{{{1.0, {0, 0, 0}, {}}, {3.0, {32, 0, 0}, {}}}};
    EXPECT_DOUBLE_EQ(translation_x(pair, 1.5), 5.0);
}

TEST(Motion, ReproducesAStraightLineBetweenInnerKeys) {
    MotionPath line;
    for (const double t : {0.0, 1.0, 1.5, 4.0, 5.0}) line.keys.push_back({t, {3 * t, -t, 0}, {0, 0, 10 * t}});
    for (double t = 1.0; t <= 4.0; t += 0.125) {
        EXPECT_NEAR(translation_x(line, t), 3 * t, 1e-12);
        EXPECT_NEAR(motion_at(line, t).rotation[3], std::sin(10 * t * std::numbers::pi / 180), 1e-12);
    }
}

/// Returns the six components of a key.
std::array<double, 6> components(const MotionKey& key) {
    const auto& [x, y, z] = key.translate;
    const auto& [a, b, c] = key.rotate;
    return {x, y, z, a, b, c};
}

TEST(Motion, NeverLeavesTheRangeOfTheKeysAroundIt) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int draw = 0; draw < 500; ++draw) {
        // Coarse values, so that many neighbours are equal.
        const auto value = [&] { return std::round(3 * uniform(random)) * (draw % 2 == 0 ? 1 : uniform(random)); };
        MotionPath path;
        double time = 0;
        for (int k = 0; k < 6; ++k) {
            time += std::pow(10, 2 * uniform(random));
            path.keys.push_back({time, {value(), value(), value()}, {90 * value(), 90 * value(), 360 * value()}});
        }
        for (std::size_t k = 0; k + 1 < path.keys.size(); ++k) {
            const auto from = components(path.keys[k]), to = components(path.keys[k + 1]);
            std::array<double, 6> last = from;
            for (int part = 1; part < 64; ++part) {
                const double share = part / 64.0;
                const auto at =
                    components(key_at(path, (1 - share) * path.keys[k].time + share * path.keys[k + 1].time));
                for (std::size_t i = 0; i < 6; ++i) {
                    const double rounding = 1e-12 * (std::abs(from[i]) + std::abs(to[i]));
                    ASSERT_GE((at[i] - last[i]) * (to[i] > from[i] ? 1 : -1), -rounding) << "it goes back";
                    ASSERT_GE(at[i], std::min(from[i], to[i]) - rounding);
                    ASSERT_LE(at[i], std::max(from[i], to[i]) + rounding);
                    if (from[i] == to[i]) {
                        ASSERT_EQ(at[i], from[i]);
                    }
                }
                last = at;
            }
        }
    }
}

TEST(Motion, RestsBetweenEqualKeysAlone) {
    const MotionPath halting{{{1, {}, {}}, {2, {0, -1, 0}, {}}, {4, {0, -1, 0}, {}}, {5, {}, {}}}};
    for (const auto& [from, to] : {std::pair{-2.0, 1.0}, {2.0, 4.0}, {2.5, 3.5}, {5.0, 9.0}})
        EXPECT_TRUE(rests(halting, from, to)) << from;
    for (const auto& [from, to] : {std::pair{0.5, 1.5}, {1.9, 3.0}, {3.0, 4.1}, {0.0, 6.0}, {1.5, 4.5}})
        EXPECT_FALSE(rests(halting, from, to)) << from;
    EXPECT_TRUE(rests(MotionPath{}, 0, 1));
}

TEST(Motion, IsContinuousInValueAndSlope) {
    constexpr double step = 1e-6;
    for (const MotionKey& key : uneven.keys) {
        const double before = translation_x(uneven, key.time - step);
        const double at = translation_x(uneven, key.time);
        const double after = translation_x(uneven, key.time + step);
        EXPECT_NEAR(before, at, 1e-5);
        EXPECT_NEAR((at - before) / step, (after - at) / step, 1e-4);
    }
}

TEST(Motion, ConstantPathStaysPut) {
    const MotionPath rest{{{0.0, {0.1, 0.7, 0.3}, {}}, {1.0, {0.1, 0.7, 0.3}, {}}, {3.0, {0.1, 0.7, 0.3}, {}}}};
    for (double t = -0.5; t < 4.0; t += 0.0625) EXPECT_EQ(motion_at(rest, t).translation, (Vec3{0.1, 0.7, 0.3}));
}

TEST(Rotation, ZeroAndWholeTurnsAreExactlyTheIdentity) {
    EXPECT_EQ(rotation_matrix({0, 0, 0}), identity);
    EXPECT_EQ(rotation_matrix({360, -720, 3600}), identity);
    for (const double entry : rotation_matrix({0, 0, 0})) EXPECT_FALSE(std::signbit(entry));
}

TEST(Rotation, TurnsCounterclockwiseAboutEachAxis) {
    EXPECT_EQ(turned(rotation_matrix({90, 0, 0}), {0, 1, 0}), (Vec3{0, 0, 1}));
    EXPECT_EQ(turned(rotation_matrix({0, 90, 0}), {0, 0, 1}), (Vec3{1, 0, 0}));
    EXPECT_EQ(turned(rotation_matrix({0, 0, 90}), {1, 0, 0}), (Vec3{0, 1, 0}));
    EXPECT_EQ(turned(rotation_matrix({0, 0, 180}), {1, 2, 3}), (Vec3{-1, -2, 3}));
    EXPECT_EQ(turned(rotation_matrix({0, 0, -90}), {1, 0, 0}), (Vec3{0, -1, 0}));
}

TEST(Rotation, AppliesXThenYThenZ) {
    // The turns take y by x to z, by y to x, by z to y; any other order ends elsewhere.
    EXPECT_EQ(turned(rotation_matrix({90, 90, 90}), {0, 1, 0}), (Vec3{0, 1, 0}));
    const Vec3 step_by_step =
        turned(rotation_matrix({0, 0, 20}),
               turned(rotation_matrix({0, 50, 0}), turned(rotation_matrix({35, 0, 0}), {1, 2, 3})));
    const Vec3 at_once = turned(rotation_matrix({35, 50, 20}), {1, 2, 3});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(at_once[i], step_by_step[i], 1e-14);
}

TEST(Rotation, AgreesWithTheFunctionsOfTheLibrary) {
    for (double degrees = -400; degrees <= 400; degrees += 7.3) {
        const auto matrix = rotation_matrix({0, 0, degrees});
        EXPECT_NEAR(matrix[0], std::cos(degrees * std::numbers::pi / 180), 1e-14);
        EXPECT_NEAR(matrix[3], std::sin(degrees * std::numbers::pi / 180), 1e-14);
    }
}

}  // namespace
}  // namespace drape
