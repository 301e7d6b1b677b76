// What shapes weigh and how they turn is held against closed forms and against meshes of the same shapes.
#include "world/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/meshes.h"

namespace drape {
namespace {

void expect_near(const MassProperties& one, const MassProperties& other, double share) {
    EXPECT_NEAR(one.volume, other.volume, share * other.volume);
    const double scale = other.inertia[0] + other.inertia[4] + other.inertia[8];
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(one.inertia[k], other.inertia[k], share * scale) << k;
}

TEST(MassProperties, BallsAndBoxesHaveTheirClosedForms) {
    const auto ball = mass_properties(Sphere{{1, 2, 3}, 0.5});
    ASSERT_TRUE(ball);
    EXPECT_NEAR(ball->volume, std::numbers::pi / 6, 1e-15);
    for (const std::size_t k : {0u, 4u, 8u}) EXPECT_NEAR(ball->inertia[k], 0.4 * ball->volume * 0.25, 1e-15);
    const auto box = mass_properties(Box{{}, {0.5, 1, 1.5}});
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->inertia[0], 6.0 / 12 * (4 + 9), 1e-14);
    EXPECT_NEAR(box->inertia[8], 6.0 / 12 * (1 + 4), 1e-14);
    EXPECT_FALSE(mass_properties(Plane{}));
}

TEST(MassProperties, ACapsuleIsTwoHalvesOfABallAndARod) {
    const double r = 0.2, half = 0.3;
    const auto capsule = mass_properties(Capsule{{0, -half, 0}, {0, half, 0}, {r, r}});
    ASSERT_TRUE(capsule);
    const double rod = std::numbers::pi * r * r * 2 * half, ball = 4 * std::numbers::pi / 3 * r * r * r;
    EXPECT_NEAR(capsule->volume, rod + ball, 1e-15);
    EXPECT_NEAR(capsule->inertia[4], rod * r * r / 2 + ball * 0.4 * r * r, 1e-15);
    const double across = rod * (r * r / 4 + half * half / 3) + ball * (0.4 * r * r + half * half + 0.75 * half * r);
    EXPECT_NEAR(capsule->inertia[0], across, 1e-15);
}

TEST(MassProperties, ATaperedCapsuleIsTheSameFromEitherEndAndEndsAsABall) {
    const auto one = mass_properties(Capsule{{0, -0.3, 0}, {0, 0.3, 0}, {0.2, 0.1}}),
               other = mass_properties(Capsule{{0, -0.3, 0}, {0, 0.3, 0}, {0.1, 0.2}});
    ASSERT_TRUE(one && other);
    expect_near(*one, *other, 1e-14);
    EXPECT_NEAR(one->center[1], -other->center[1], 1e-14);
    // As the small end sinks into the large one, nothing jumps.
    const double apart = 0.1 * (1 + 1e-9);
    const auto nearly = mass_properties(Capsule{{0, 0, 0}, {0, apart, 0}, {0.2, 0.1}}),
               ball = mass_properties(Sphere{{}, 0.2});
    expect_near(*nearly, *ball, 1e-6);
}

TEST(MassProperties, MeshesWeighWhatTheyAreTrianglesOf) {
    expect_near(*mass_properties(test::mesh_of(test::box_mesh({0.3, 0.2, 0.5}), {})),
                *mass_properties(Box{{}, {0.3, 0.2, 0.5}}), 1e-14);
    expect_near(*mass_properties(test::mesh_of(test::ball_mesh(0.5, 256), {})), *mass_properties(Sphere{{}, 0.5}),
                1e-3);
    expect_near(*mass_properties(test::mesh_of(test::capsule_mesh(0.3, 0.2, 256), {})),
                *mass_properties(Capsule{{0, -0.3, 0}, {0, 0.3, 0}, {0.2, 0.2}}), 1e-3);
    // A wedge, whose centre of mass is not the middle of its box: half of a unit cube.
    test::Triangles wedge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                          {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}}};
    const auto mass = mass_properties(test::mesh_of(wedge, {}));
    ASSERT_TRUE(mass);
    EXPECT_NEAR(mass->volume, 0.5, 1e-15);
    EXPECT_NEAR(mass->center[0], 1.0 / 3 - 0.5, 1e-15);
    EXPECT_NEAR(mass->inertia[8], 0.5 / 9, 1e-15);  // of the triangle: area (a^2 + b^2)/18
    EXPECT_NEAR(mass->inertia[1], 0.5 / 36, 1e-15);
}

}  // namespace
}  // namespace drape
