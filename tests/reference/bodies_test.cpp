// Bodies that cloth moves, against statics and the momenta of what touches, for every method.
#include "cloth/bodies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/vectors.h"
#include "simulated_bodies.h"
#include "world/mass_properties.h"

namespace drape {
namespace {

using test::all_methods;
using test::ball;
using test::Bodies;
using test::by_method;
using test::expect_near;
using test::level_sheet;
using test::momenta;

TEST(BodiesTest, ABodyFliesAlongAParabola) {
    SceneDescription scene = by_method(level_sheet(5, 4), SolverMethod::explicit_steps, 4);
    scene.colliders = {ball({0, 1, 0}, 0.1, 0.5)};
    scene.colliders[0].velocity = {1, 2, 0};
    scene.colliders[0].angular_velocity = {0, 0, 3};
    Bodies run(scene);
    expect_near(run.body().velocity, {1, 2, 0}, 1e-6, "the start");
    run.frames(60);
    expect_near(run.body().position, {1, 1 + 2 - 0.5 * 9.81, 0}, 1e-5, "after a second");
    expect_near(run.body().velocity, {1, 2 - 9.81, 0}, 1e-5, "after a second");
    expect_near(run.body().angular_velocity, {0, 0, 3}, 1e-5, "after a second");
}

TEST(BodiesTest, ABoxSlidesAndRestsOnAPlaneByCoulombsLaw) {
    SceneDescription scene = by_method(level_sheet(5, 4), SolverMethod::explicit_steps, 4);
    Collider box{Box{{0, 0.05, 0}, {0.1, 0.05, 0.08}}};
    box.mass = 2;
    box.friction = 0.2;
    box.velocity = {1, 0, 0};
    Collider floor{Plane{}};
    floor.friction = 0.2;
    scene.colliders = {floor, box};
    Bodies run(scene);
    run.frames(15);
    const double time = 0.25, slowing = 0.2 * 9.81;
    expect_near(run.body().velocity, {1 - slowing * time, 0, 0}, 2e-3, "the velocity of a box that slides");
    run.frames(60);
    EXPECT_NEAR(run.body().position[0], 0.5 / slowing, 2e-3) << "where it comes to rest";
    EXPECT_NEAR(run.body().position[1], 0.05, 1e-5);
    EXPECT_LT(length(run.body().velocity), 1e-6);
}

TEST(BodiesTest, ABallRollsDownAPlane) {
    SceneDescription scene = by_method(level_sheet(5, 4), SolverMethod::explicit_steps, 4);
    const double angle = 0.3;
    Collider slope{Plane{{std::sin(angle), std::cos(angle), 0}, 0}};
    slope.friction = 0.5;
    scene.colliders = {slope, ball({0.1 * std::sin(angle), 0.1 * std::cos(angle), 0}, 0.1, 1)};
    scene.colliders[1].friction = 0.5;
    Bodies run(scene);
    run.frames(60);
    const double way = 0.5 * 5 / 7 * 9.81 * std::sin(angle);
    expect_near(minus(run.body().position, {0.1 * std::sin(angle), 0.1 * std::cos(angle), 0}),
                {way * std::cos(angle), -way * std::sin(angle), 0}, 1e-3, "a ball that rolls for a second");
}

class BodiesByMethod : public testing::TestWithParam<SolverMethod> {};

/// A ball flies into a sheet that nothing holds, without gravity, beside its middle.
TEST_P(BodiesByMethod, AFreeSheetAndABallKeepTheirMomenta) {
    SceneDescription scene = by_method(level_sheet(0, 0), GetParam(), 16);
    // A substep's error of the cloth's own angular momentum is of the first order.
    if (GetParam() != SolverMethod::explicit_steps) scene.solver.substeps = 64;
    scene.gravity = {0, 0, 0};
    scene.colliders = {ball({0.03, 0.12, 0.02}, 0.1, 0.3)};
    scene.colliders[0].velocity = {0.3, -1, 0.1};
    scene.colliders[0].angular_velocity = {0, 4, 0};
    Bodies run(scene);
    const BodyState before = run.body();
    const Vec3 momentum = before.momentum, turning = before.angular_momentum;
    run.frames(40);
    const auto [of_cloth, turning_of_cloth] = momenta(run);
    EXPECT_GT(length(of_cloth), 0.02 * length(momentum)) << "they meet";
    expect_near(plus(of_cloth, run.body().momentum), momentum, 1e-4, "momentum");
    std::printf("[ measured ] cloth took back %.1e of it\n", length(run.statistics().angular_error) / length(turning));
    expect_near(plus(turning_of_cloth, run.body().angular_momentum), turning, 1e-4, "angular momentum");
}

/// A ball flies at the seam of two sheets of unlike density that nothing holds, without gravity.
TEST_P(BodiesByMethod, SewnSheetsAndABallKeepTheirMomentum) {
    if (GetParam() == SolverMethod::explicit_steps) GTEST_SKIP() << "refused: seam_rules_test";
    SceneDescription scene = by_method(level_sheet(0, 0), GetParam(), 64);
    scene.gravity = {0, 0, 0};
    Cloth other = scene.cloths[0];
    other.name = "other";
    other.areal_density *= 3;
    other.placement.origin[2] += scene.cloths[0].size[1];
    scene.cloths.push_back(other);
    scene.seams = {{{scene.cloths[0].name, SeamEdge::bottom}, {"other", SeamEdge::top}}};
    const Vec3 middle = scene.cloths[1].placement.origin;
    scene.colliders = {ball({middle[0] + 0.5 * other.size[0] + 0.03, 0.12, middle[2] + 0.02}, 0.1, 0.3)};
    scene.colliders[0].velocity = {0.3, -1, 0.1};
    scene.colliders[0].friction = 0.3;
    Bodies run(scene);
    const Vec3 momentum = run.body().momentum, turning = run.body().angular_momentum;
    run.frames(40);
    const auto [of_one, turning_of_one] = momenta(run, 0);
    const auto [of_other, turning_of_other] = momenta(run, 1);
    EXPECT_GT(length(of_one), 0.01 * length(momentum)) << "they meet";
    EXPECT_GT(length(of_other), 0.01 * length(momentum)) << "they meet";
    const Vec3 lost = minus(plus(plus(of_one, of_other), run.body().momentum), momentum);
    const Vec3 turned = minus(plus(plus(turning_of_one, turning_of_other), run.body().angular_momentum), turning);
    std::printf("[ measured ] momentum %.1e of the ball's, angular momentum %.1e kg m2/s\n",
                length(lost) / length(momentum), length(turned));
    EXPECT_LT(length(lost), 1e-4 * length(momentum));
}

/// A ball falls into a sheet that is held at its corners, and comes to rest there.
TEST_P(BodiesByMethod, PinsBearABallInASheet) {
    SceneDescription scene = by_method(level_sheet(0, 200), GetParam(), GetParam() == SolverMethod::relax ? 64 : 16);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(8, 0, 8, 0), test::pin_box(0, 8, 0, 8),
                            test::pin_box(8, 8, 8, 8)};
    scene.colliders = {ball({0, 0.11, 0}, 0.1, 0.4)};
    Bodies run(scene);
    run.frames(300);
    std::printf("[ measured ] height %.5f, speed %.1e\n", run.body().position[1], length(run.body().velocity));
    const double weight = 0.4 * 9.81;
    Vec3 pins{};
    for (int k = 0; k < 4; ++k) pins = plus(pins, run.force("pins_" + std::to_string(k)));
    EXPECT_LT(length(run.body().velocity), 1e-3);
    expect_near(pins, {0, weight + run.weight(), 0}, 1e-3, "what four pins bear");
    expect_near(run.force("collider_0_sphere"), {0, -weight, 0}, 1e-3, "the ball's weight");
}

/// Returns the largest speed of a run's body in the next frames, m/s.
double peak_speed(Bodies& run, int frames) {
    double most = 0;
    for (int frame = 0; frame < frames; ++frame) {
        run.frames(1);
        most = std::max(most, length(run.body().velocity));
    }
    return most;
}

/// Balls in a hammock, the first of which is just heavy enough not to be light, swing less and less: what rattles or
/// grows by the late answer of cloth keeps its speed.
TEST_P(BodiesByMethod, ALightBallRestsInASheet) {
    for (const double ratio : {light_mass_ratio * 1.01, 1.0, 0.4, least_mass_ratio * 1.001}) {
        SceneDescription scene =
            by_method(level_sheet(0, 200), GetParam(), GetParam() == SolverMethod::relax ? 64 : 16);
        scene.cloths[0].pins = {test::pin_box(0, 0, 8, 0), test::pin_box(0, 8, 8, 8)};
        scene.colliders = {ball({0, 0.11, 0}, 0.1, ratio * covering_mass(scene, Sphere{{}, 0.1}))};
        Bodies run(scene);
        const double first = peak_speed(run, 60);
        run.frames(180);
        const double last = peak_speed(run, 60);
        const double weight = *scene.colliders[0].mass * 9.81;
        std::printf(
            "[ measured ] %.2f times the cloth on it: peak speed %.1e in the first second, %.1e in the fifth, "
            "weight off by %.1e of it\n",
            ratio, first, last, length(minus(run.force("collider_0_sphere"), {0, -weight, 0})) / weight);
        EXPECT_LT(last, 0.5 * first) << ratio;
    }
}

/// Momenta of what is light beside the cloth that touches it are kept too.
TEST_P(BodiesByMethod, MassesAreUnlike) {
    for (const double mass : {0.003, 0.01, 0.02, 0.05, 0.1, 10.0}) {
        SceneDescription scene = by_method(level_sheet(0, 0), GetParam(), 16);
        scene.gravity = {0, 0, 0};
        scene.colliders = {ball({0.03, 0.12, 0.02}, 0.1, mass)};
        scene.colliders[0].velocity = {0, -1, 0};
        Bodies run(scene);
        run.frames(40);
        const ClothStatistics cloth = run.statistics();
        const Vec3 momentum = plus(momenta(run).first, run.body().momentum);
        expect_near(momentum, {0, -mass, 0}, 1e-3, "momentum");
        const double energy = cloth.kinetic_energy + cloth.elastic_energy + run.body().kinetic_energy;
        std::printf("[ measured ] %g kg beside %g: momentum off by %.1e, energy %.4f of before\n", mass, cloth.mass,
                    length(minus(momentum, {0, -mass, 0})) / mass, energy / (0.5 * mass));
        EXPECT_LT(energy, 0.5 * mass * 1.001);
    }
}

/// Cloth flies at a ball that weighs as little as one may, and wraps it.
TEST_P(BodiesByMethod, WrappingALightBallMakesNoEnergy) {
    for (const double ratio : {light_mass_ratio, 1.0, 0.4, least_mass_ratio}) {
        SceneDescription scene = by_method(test::sheet(25, 25, 0.5, 0.5, 8), GetParam(), 16);
        scene.gravity = {0, 0, 0};
        Cloth& cloth = scene.cloths[0];
        cloth.pins.clear();
        cloth.stiffness = {false, 1000, 20, 0};
        cloth.placement = {{-0.25, 0.13, -0.25}, {1, 0, 0}, {0, 0, 1}};
        cloth.velocity = {0, -2, 0};
        cloth.thickness = 0.004;
        cloth.friction = 0.5;
        const double mass = ratio * cloth.areal_density * surface_area(Sphere{{}, 0.1});
        scene.colliders = {ball({0.01, 0, 0.02}, 0.1, mass)};
        Bodies run(scene);
        double most = 0;
        const double before = 0.5 * 4 * cloth.areal_density * 0.25;
        for (int frame = 0; frame < 40; ++frame) {
            run.frames(1);
            const ClothStatistics now = run.statistics();
            // What relaxation leaves of stretch is no energy that it has.
            const double elastic = GetParam() == SolverMethod::relax ? 0 : now.elastic_energy;
            most = std::max(most, now.kinetic_energy + elastic + run.body().kinetic_energy);
        }
        std::printf("[ measured ] %.2f times the cloth on it: at most %.4f of the energy before, the ball %.4f m/s\n",
                    ratio, most / before, run.body().velocity[1]);
        EXPECT_LT(most, 1.001 * before) << ratio;
        const Vec3 momentum = plus(momenta(run).first, run.body().momentum);
        expect_near(momentum, {0, -2 * cloth.areal_density * 0.25, 0}, 1e-3, "momentum");
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, BodiesByMethod, testing::ValuesIn(all_methods),
                         [](const auto& method) { return std::string(named(method.param).name); });

}  // namespace
}  // namespace drape
