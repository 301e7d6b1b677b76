// A rigid body alone moves by closed forms: it falls, it precesses, and its momenta stay.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shared/glsl_types.h"

namespace drape::glsl {
namespace {

#include "include/rigid_body.h"

TEST(RigidBody, FallsAsItsStepsSay) {
    RigidBody body{{0, 100, 0}, {0, 0, 0}, {0, 0, 0, 1}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    const int steps = 1200;
    const float step = 1.0f / 1200;
    for (int k = 0; k < steps; ++k) body = advanced_body(body, {1, 1, 1}, {0, -9.81f, 0}, step);
    // Semi-implicit: g h^2 n (n + 1)/2. Without what is kept of rounding it would be off by some 1e-3 m here.
    EXPECT_NEAR(body.position.y, 100 - 9.81 * 0.5 * (1 + 1.0 / steps), 2e-5);
    EXPECT_NEAR(body.position.x, 1, 1e-6);
    EXPECT_NEAR(body.velocity.y, -9.81, 2e-5);
}

double energy(const RigidBody& body, vec3 inverse) {
    const vec3 rate = angular_velocity(body.turn, body.spin, inverse);
    return 0.5 * (double{rate.x} * body.spin.x + double{rate.y} * body.spin.y + double{rate.z} * body.spin.z);
}

TEST(RigidBody, ASymmetricTopPrecesses) {
    // About its own axis z it turns with 1/0.5, across with 1: the axis goes around the momentum with L/I across.
    const vec3 inverse{1, 1, 2};
    RigidBody body{{0, 0, 0}, {0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0.6f, 0, 0.8f}};
    const int steps = 2000;
    const double time = 3;
    for (int k = 0; k < steps; ++k) body = advanced_body(body, inverse, {0, 0, 0}, static_cast<float>(time / steps));
    const vec3 axis = turned_by_quaternion(body.turn, {0, 0, 1});
    // The axis z turned about (0.6, 0, 0.8) by 3 rad (Rodrigues).
    const double c = std::cos(time), s = std::sin(time);
    EXPECT_NEAR(axis.x, 0.6 * 0.8 * (1 - c), 1e-4);
    EXPECT_NEAR(axis.y, -0.6 * s, 1e-4);
    EXPECT_NEAR(axis.z, c + 0.64 * (1 - c), 1e-4);
    EXPECT_EQ(body.spin.x, 0.6f);
    EXPECT_EQ(body.spin.z, 0.8f);
}

TEST(RigidBody, ATumblingOneKeepsItsEnergy) {
    const vec3 inverse{1, 0.5f, 0.3f};
    RigidBody body{{0, 0, 0}, {0, 0, 0}, {0, 0, 0, 1},
                   {0, 0, 0}, {0, 0, 0}, {0.01f, 2, 0.02f}};  // about the middle axis
    const double start = energy(body, inverse);
    double least = 1;
    for (int k = 0; k < 6000; ++k) {
        body = advanced_body(body, inverse, {0, 0, 0}, 0.01f);
        EXPECT_NEAR(energy(body, inverse), start, 3e-4 * start);
        least = std::min(least, double{turned_by_quaternion(body.turn, {0, 1, 0}).y});
    }
    EXPECT_LT(least, -0.9) << "it flips over";
}

}  // namespace
}  // namespace drape::glsl
