// A substep's iterations end when the RMS of the stretch error is within the tolerance.
#include <gtest/gtest.h>

#include <limits>

#include "twin/kernels.h"

namespace drape::glsl {
namespace {

constexpr float tolerance = 0.01f, squared = tolerance * tolerance;

/// `count` springs of 0.5 m, all of them stretched by this share.
ResidualRecord stretched(float error, int count) {
    ResidualRecord record = empty_residual();
    for (int k = 0; k < count; ++k) record = add_residual(record, vec3{0, 0.5f * (1 + error), 0}, 0.5f, 1, 1, 0);
    return record;
}

TEST(Residual, IterationsGoOnAboveTheToleranceAndEndBelow) {
    for (const int count : {1, 7, 1000})
        for (const float sign : {-1.0f, 1.0f}) {
            EXPECT_TRUE(needs_iteration(stretched(sign * 1.02f * tolerance, count), squared)) << count;
            EXPECT_FALSE(needs_iteration(stretched(sign * 0.98f * tolerance, count), squared)) << count;
        }
}

TEST(Residual, ItIsTheMeanOverSprings) {
    ResidualRecord half = joined(stretched(0, 50), stretched(1.38f * tolerance, 50));
    EXPECT_FALSE(needs_iteration(half, squared));
    half = joined(stretched(0, 50), stretched(1.45f * tolerance, 50));
    EXPECT_TRUE(needs_iteration(half, squared));
}

TEST(Residual, WhatIsNoSpringDoesNotCountAndTensionIsNoError) {
    ResidualRecord record = add_residual(empty_residual(), vec3{9, 0, 0}, 0.5f, 0, 1, 0);  // cut
    record = add_residual(record, vec3{9, 0, 0}, 0, 1, 1, 0);                              // none along this direction
    EXPECT_EQ(record.count, 0u);
    record = add_residual(record, vec3{0.75f, 0, 0}, 0.5f, 1, 1, 0.25f);
    EXPECT_EQ(record.count, 1u);
    EXPECT_FALSE(needs_iteration(record, squared));
}

TEST(Residual, WhatIsNotFiniteIsNotWithinAnyTolerance) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(needs_iteration(add_residual(empty_residual(), vec3{nan, 0, 0}, 0.5f, 1, 1, 0), squared));
}

}  // namespace
}  // namespace drape::glsl
