#include "world/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
    // The second one has 2 -> 3 in 3 s, slopes 0.75 and (-1 - 2) / (5 - 1) = -0.75.
    EXPECT_DOUBLE_EQ(translation_x(uneven, 2.5), 2.5 + 3.0 * (0.75 + 0.75) / 8);
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
