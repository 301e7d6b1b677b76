// Bodies that meet each other and what has no mass, against the momenta, statics and Coulomb's law.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "mesh/mesh_shape.h"
#include "simulated_bodies.h"

namespace drape {
namespace {

using test::ball;
using test::Bodies;
using test::by_method;
using test::expect_near;
using test::level_sheet;

Collider box(const Vec3& center, const Vec3& half_extents, double mass) {
    Collider body{Box{center, half_extents}};
    body.mass = mass;
    return body;
}
Collider rod(const Vec3& from, const Vec3& to, double radius, double mass) {
    Collider body{Capsule{from, to, {radius, radius}}};
    body.mass = mass;
    return body;
}

/// A scene with a sheet that nothing touches, 30 m beside.
SceneDescription beside_a_sheet(std::vector<Collider> colliders, std::uint32_t substeps = 20) {
    SceneDescription scene = by_method(level_sheet(5, 4), SolverMethod::explicit_steps, substeps);
    scene.cloths[0].placement.origin[2] += 30;
    scene.colliders = std::move(colliders);
    return scene;
}

struct Sums {
    Vec3 momentum{}, angular{};
    double kinetic = 0, energy = 0;
};
Sums sums_of(const Bodies& run) {
    Sums sums;
    for (std::size_t k = 0; k < body_count(run.model()); ++k) {
        const BodyState body = run.body(k);
        sums.momentum = plus(sums.momentum, body.momentum);
        sums.angular = plus(sums.angular, body.angular_momentum);
        sums.kinetic += body.kinetic_energy;
        sums.energy += body.kinetic_energy + body.potential_energy;
    }
    return sums;
}

struct Collision {
    const char* name;
    Collider one, other;  ///< the second flies along -x at the first
};

/// The share of its energy that a substep of free flight may give to a body that turns: its angular momentum is kept as
/// it is, and its turn is rounded to single precision.
constexpr double rounded_turn = 1.2e-7;

class BodiesMeet : public testing::TestWithParam<Collision> {};

/// Two that fly at each other beside their middles, and turn.
TEST_P(BodiesMeet, KeepTheirMomentaAndMakeNoEnergy) {
    SceneDescription scene = beside_a_sheet({GetParam().one, GetParam().other});
    scene.gravity = {0, 0, 0};
    scene.colliders[0].velocity = {0.2, 0.05, 0};
    scene.colliders[0].angular_velocity = {0.3, 0.5, -1};
    scene.colliders[1].velocity = {-1, 0.1, 0.05};
    scene.colliders[1].angular_velocity = {1, -0.4, 0.6};
    Bodies run(scene);
    const Sums before = sums_of(run);
    const Vec3 flying = run.body(0).momentum;
    double most = before.kinetic, gained = 0;
    for (int frame = 0; frame < 60; ++frame) {
        run.frames(1);
        const double now = sums_of(run).kinetic;
        gained = std::max(gained, now / most - 1);
        most = now;
    }
    std::printf("[ measured ] gain of energy in a frame at most %.1e\n", gained);
    EXPECT_LT(gained, 20 * rounded_turn);
    const Sums after = sums_of(run);
    const double exchanged = length(minus(run.body(0).momentum, flying));
    EXPECT_GT(exchanged, 0.1) << "they meet";
    std::printf("[ measured ] momentum off by %.1e, angular momentum by %.1e of 1; energy %.3f of before\n",
                length(minus(after.momentum, before.momentum)), length(minus(after.angular, before.angular)),
                after.kinetic / before.kinetic);
    expect_near(after.momentum, before.momentum, 1e-6, "momentum");
    // Arms are known to 6e-8 m, a metre from the origin, and impulses act at them in up to 128 rounds.
    expect_near(after.angular, before.angular, 1e-5, "angular momentum");
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, BodiesMeet,
    testing::Values(
        Collision{"balls", ball({0, 1, 0}, 0.1, 1), ball({0.4, 1.06, 0.03}, 0.15, 0.5)},
        Collision{"ball_and_box", ball({0, 1, 0}, 0.1, 1), box({0.4, 1.06, 0.03}, {0.1, 0.15, 0.08}, 0.7)},
        Collision{"boxes", box({0, 1, 0}, {0.1, 0.1, 0.1}, 1), box({0.5, 1.06, 0.03}, {0.1, 0.15, 0.08}, 0.7)},
        Collision{"ball_and_rod", ball({0, 1, 0}, 0.1, 1), rod({0.4, 0.8, 0}, {0.45, 1.2, 0.1}, 0.05, 0.8)},
        Collision{"box_and_rod", box({0, 1, 0}, {0.1, 0.1, 0.1}, 1), rod({0.4, 0.8, 0}, {0.45, 1.2, 0.1}, 0.05, 0.8)},
        Collision{"rods", rod({0, 1, -0.3}, {0, 1.1, 0.3}, 0.06, 1), rod({0.4, 0.8, 0}, {0.45, 1.2, 0.1}, 0.05, 0.8)}),
    [](const auto& collision) { return std::string(collision.param.name); });

/// What a rod gains as it tumbles alone is what rounding its turn gives: shorter substeps make it no less, as they
/// would the midpoint's own error.
TEST(BodyMeeting, AFreeTurnGainsByRoundingAlone) {
    for (const std::uint32_t substeps : {20u, 40u, 80u}) {
        SceneDescription scene = beside_a_sheet({rod({0.4, 0.8, 0}, {0.45, 1.2, 0.1}, 0.05, 0.8)}, substeps);
        scene.gravity = {0, 0, 0};
        scene.colliders[0].angular_velocity = {1, -2, 3};
        Bodies run(scene);
        double most = sums_of(run).kinetic, gained = 0;
        for (int frame = 0; frame < 60; ++frame) {
            run.frames(1);
            const double now = sums_of(run).kinetic;
            gained = std::max(gained, now / most - 1);
            most = now;
        }
        std::printf("[ measured ] %u substeps: gain of energy in a frame at most %.1e\n", substeps, gained);
        EXPECT_LT(gained, substeps * rounded_turn);
    }
}

/// Two balls of one mass that meet head on go on as one.
TEST(BodyMeeting, AnImpactIsInelastic) {
    SceneDescription scene = beside_a_sheet({ball({0, 1, 0}, 0.1, 1), ball({0.4, 1, 0}, 0.1, 1)});
    scene.gravity = {0, 0, 0};
    scene.colliders[1].velocity = {-1, 0, 0};
    Bodies run(scene);
    run.frames(60);
    for (const std::size_t k : {0u, 1u}) expect_near(run.body(k).velocity, {-0.5, 0, 0}, 1e-6, "velocity");
    EXPECT_NEAR(distance(run.body(0).position, run.body(1).position), 0.2, 1e-5) << "they touch";
}

class Piles : public testing::TestWithParam<std::size_t> {};

TEST_P(Piles, StayOnAPlane) {
    std::vector<Collider> colliders{Collider{Plane{}}};
    for (std::size_t k = 0; k < GetParam(); ++k)
        colliders.push_back(box({0, 0.05 + 0.1 * static_cast<double>(k), 0}, {0.05, 0.05, 0.05}, 1));
    Bodies run(beside_a_sheet(colliders));
    run.frames(120);
    for (std::size_t k = 0; k < GetParam(); ++k) {
        const BodyState& body = run.body(k);
        const Vec3 drift = minus(body.position, {0, 0.05 + 0.1 * static_cast<double>(k), 0});
        std::printf("[ measured ] box %zu: off by %.1e %.1e %.1e m, speed %.1e m/s, turned by %.1e\n", k, drift[0],
                    drift[1], drift[2], length(body.velocity),
                    2 * std::hypot(body.turn[0], body.turn[1], body.turn[2]));
        EXPECT_LT(length(drift), 1e-4);
        EXPECT_LT(length(body.velocity), 1e-3);
    }
}
INSTANTIATE_TEST_SUITE_P(Boxes, Piles, testing::Values(2u, 5u));

/// A body on a standing box whose top slopes down along x. The first is the box.
SceneDescription on_a_slope(Collider body, double angle, double friction) {
    Collider slope{Box{{0, 0, 0}, {2, 0.1, 1}}};
    slope.rotate = {0, 0, -angle * 180 / std::numbers::pi};
    slope.friction = body.friction = friction;
    std::vector<Collider> all{slope, body};
    if (body.kind() < slope.kind()) std::swap(all[0], all[1]);
    return beside_a_sheet(all);
}

TEST(BodyMeeting, ABallSlidesDownAStandingBoxByCoulombsLaw) {
    const double angle = 0.4, friction = 0.05, radius = 0.1, g = 9.81, time = 0.5;
    const Vec3 up{std::sin(angle), std::cos(angle), 0}, along{std::cos(angle), -std::sin(angle), 0};
    const Vec3 start = plus(times(0.1 + radius, up), times(-1, along));
    Bodies run(on_a_slope(ball(start, radius, 0.7), angle, friction));
    run.frames(30);
    const double slides = g * (std::sin(angle) - friction * std::cos(angle));
    std::printf("[ measured ] way %.6f, expected %.6f; turn %.6f, expected %.6f\n",
                dot(minus(run.body().position, start), along), 0.5 * slides * time * time,
                run.body().angular_velocity[2], -2.5 * friction * g * std::cos(angle) / radius * time);
    expect_near(minus(run.body().position, start), times(0.5 * slides * time * time, along), 1e-3, "way");
    expect_near(run.body().angular_velocity, {0, 0, -2.5 * friction * g * std::cos(angle) / radius * time}, 1e-3,
                "turn");
}

TEST(BodyMeeting, ABoxSlidesOrStaysOnAStandingBox) {
    const double angle = 0.4, g = 9.81, time = 0.5;
    const Vec3 up{std::sin(angle), std::cos(angle), 0}, along{std::cos(angle), -std::sin(angle), 0};
    const Vec3 start = plus(times(0.15, up), times(-1, along));
    for (const double friction : {0.2, 0.5}) {
        Collider body = box(start, {0.1, 0.05, 0.08}, 1.5);
        body.rotate = {0, 0, -angle * 180 / std::numbers::pi};
        Bodies run(on_a_slope(body, angle, friction));
        run.frames(30);
        const double slides = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
        const double way = 0.5 * slides * time * time;
        const double off = distance(run.body().position, plus(start, times(way, along)));
        std::printf("[ measured ] friction %.1f: way %.6f, off by %.1e; turns by %.1e rad/s\n", friction, way, off,
                    length(run.body().angular_velocity));
        EXPECT_LT(off, 1e-3 * 0.25);
        EXPECT_LT(length(run.body().angular_velocity), 1e-3);
    }
}

/// A rod lies on a table, and a ball on a standing ball's top falls off beside.
TEST(BodyMeeting, ARodRestsOnAStandingBox) {
    Collider table{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}};
    Bodies run(beside_a_sheet({table, rod({-0.6, 0.15, 0.1}, {0.3, 0.15, 0.2}, 0.05, 1)}));
    run.frames(60);
    std::printf("[ measured ] height %.6f, speed %.1e\n", run.body().position[1], length(run.body().velocity));
    EXPECT_NEAR(run.body().position[1], 0.15, 1e-4);
    EXPECT_LT(length(run.body().velocity), 1e-3);
}

/// What a path moves carries and pushes bodies.
TEST(BodyMeeting, AColliderOnAPathCarriesABox) {
    Collider table{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}};
    table.friction = 0.8;
    table.path.keys = {{0, {0, 0, 0}}, {1, {0.2, 0, 0}}};
    Collider load = box({0, 0.15, 0}, {0.05, 0.05, 0.05}, 1);
    load.friction = 0.8;
    Bodies run(beside_a_sheet({table, load}));
    run.frames(60);
    EXPECT_NEAR(run.body().position[0], 0.2, 1e-3);
    EXPECT_NEAR(run.body().position[1], 0.15, 1e-4);
}

/// Many at once in a tray: their energy only falls, and none leaves it.
TEST(BodyMeeting, AHeapInATrayMakesNoEnergy) {
    std::vector<Collider> colliders{Collider{Plane{}}};
    for (int k = 0; k < 6; ++k)
        colliders.push_back(ball({0.12 * (k % 2) - 0.05, 0.1 + 0.13 * (k / 2), 0.11 * (k % 3) - 0.1}, 0.05, 0.3));
    for (const double side : {-1.0, 1.0}) {
        colliders.push_back(Collider{Box{{side * 0.35, 0.2, 0}, {0.1, 0.3, 0.35}}});
        colliders.push_back(Collider{Box{{0, 0.2, side * 0.35}, {0.25, 0.3, 0.1}}});
    }
    for (int k = 0; k < 3; ++k) {
        colliders.push_back(box({0.02 * k, 0.5 + 0.15 * k, 0.01 * k}, {0.05, 0.04, 0.06}, 0.5));
        colliders.back().rotate = {20.0 * k, 30, 10};
    }
    colliders.push_back(rod({-0.1, 0.95, 0}, {0.1, 1, 0.05}, 0.03, 0.4));
    Bodies run(beside_a_sheet(colliders));
    double most = sums_of(run).energy;
    for (int frame = 0; frame < 90; ++frame) {
        run.frames(1);
        const double now = sums_of(run).energy;
        EXPECT_LT(now, most + 2e-3) << "frame " << frame;
        most = std::min(most, now);
    }
    std::printf("[ measured ] kinetic energy after 1.5 s: %.1e J\n", sums_of(run).kinetic);
    EXPECT_LT(sums_of(run).kinetic, 0.1) << "of 20 J that they fell by; balls roll on";
    for (std::size_t k = 0; k < body_count(run.model()); ++k) {
        EXPECT_GT(run.body(k).position[1], 0.02);
        EXPECT_LT(std::max(std::abs(run.body(k).position[0]), std::abs(run.body(k).position[2])), 0.25);
    }
}

/// Returns a mesh with eight corners, which `shape` moves, of a box about a point.
template <class Move>
Collider mesh_of_a_box(const Vec3& center, const Vec3& half, double mass, const Move& shape) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.push_back(
            shape(Vec3{(k & 1 ? 1 : -1) * half[0], (k & 2 ? 1 : -1) * half[1], (k & 4 ? 1 : -1) * half[2]}));
    const std::vector<Triangle> triangles{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    Mesh mesh{.file = "corners", .position = center};
    mesh.shape = std::make_shared<MeshShape>(corners, triangles, std::nullopt);
    Collider body{mesh};
    body.mass = mass;
    return body;
}

/// A mesh that is a box falls on a plane's edge first, tumbles and is struck by a ball, and so does the box.
TEST(BodyMeeting, ABoxAsAMeshMovesAsTheBox) {
    const Vec3 center{0, 0.3, 0}, half{0.1, 0.05, 0.08};
    std::vector<BodyState> found;
    for (const bool as_mesh : {false, true}) {
        Collider body =
            as_mesh ? mesh_of_a_box(center, half, 2, [](const Vec3& v) { return v; }) : box(center, half, 2);
        body.rotate = {10, 20, 30};
        body.velocity = {0.3, 0, 0.1};
        body.angular_velocity = {1, 2, 3};
        const Collider elsewhere{Box{{9, 9, 9}, {1, 1, 1}}};  // so that the box meets the plane as the mesh does
        Bodies run(beside_a_sheet(as_mesh ? std::vector{Collider{Plane{}}, elsewhere, body}
                                          : std::vector{Collider{Plane{}}, body, elsewhere}));
        run.frames(14);  // it falls 0.2 m in 12, and strikes with a corner
        found.push_back(run.body());
    }
    EXPECT_GT(length(minus(found[0].angular_velocity, {1, 2, 3})), 1) << "it has struck the plane";
    expect_near(found[1].position, found[0].position, 1e-5, "position");
    expect_near(found[1].velocity, found[0].velocity, 1e-4, "velocity");
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[1].turn[k], found[0].turn[k], 1e-5) << "turn " << k;
}

/// The principal axes of a skew solid lie across its sides.
TEST(BodyMeeting, ASkewMeshKeepsItsAngularMomentumInFlight) {
    Collider body = mesh_of_a_box({0, 5, 0}, {0.2, 0.05, 0.1}, 1.5, [](const Vec3& v) {
        return Vec3{v[0] + 0.8 * v[1] + 0.3, v[1] + 0.3 * v[2], v[2] - 0.4 * v[0]};
    });
    body.velocity = {0.5, 2, 0};
    body.angular_velocity = {5, 0.1, 3};
    SceneDescription scene = beside_a_sheet({body});
    scene.gravity = {0, 0, 0};
    Bodies run(scene);
    const BodyState before = run.body();
    run.frames(120);
    const BodyState after = run.body();
    expect_near(after.angular_momentum, before.angular_momentum, 1e-6, "angular momentum");
    expect_near(before.angular_velocity, {5, 0.1, 3}, 1e-5, "the start");
    std::printf("[ measured ] energy %.8f of before\n", after.kinetic_energy / before.kinetic_energy);
    EXPECT_NEAR(after.kinetic_energy / before.kinetic_energy, 1, 1e-4);
    EXPECT_GT(length(minus(after.angular_velocity, before.angular_velocity)), 0.1) << "it tumbles";
}

/// A mesh lies on a standing box, a ball on the mesh, and a box stands on a mesh that has no mass.
TEST(BodyMeeting, MeshesBearAndAreBorne) {
    const auto as_it_is = [](const Vec3& v) { return v; };
    Collider table{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}};
    Collider stand = mesh_of_a_box({2, 0, 0}, {0.3, 0.1, 0.3}, 1, as_it_is);
    stand.mass.reset();
    SceneDescription scene =
        beside_a_sheet({ball({0.01, 0.25, 0.02}, 0.05, 0.2), table, box({2, 0.15, 0}, {0.05, 0.05, 0.05}, 1),
                        mesh_of_a_box({0, 0.15, 0}, {0.1, 0.05, 0.08}, 2, as_it_is), stand});
    Bodies run(scene);
    run.frames(60);
    const double heights[] = {0.25, 0.15, 0.15};
    for (std::size_t k = 0; k < 3; ++k) {
        std::printf("[ measured ] body %zu: off by %.1e m, speed %.1e m/s\n", k, run.body(k).position[1] - heights[k],
                    length(run.body(k).velocity));
        EXPECT_NEAR(run.body(k).position[1], heights[k], 2e-4);
        EXPECT_LT(length(run.body(k).velocity), 2e-3);
    }
}

/// Two meshes collide.
TEST(BodyMeeting, MeshesKeepTheirMomenta) {
    const auto as_it_is = [](const Vec3& v) { return v; };
    SceneDescription scene = beside_a_sheet({mesh_of_a_box({0, 1, 0}, {0.1, 0.1, 0.1}, 1, as_it_is),
                                             mesh_of_a_box({0.5, 1.06, 0.03}, {0.1, 0.15, 0.08}, 0.7, as_it_is)});
    scene.gravity = {0, 0, 0};
    scene.colliders[0].angular_velocity = {0.3, 0.5, -1};
    scene.colliders[1].velocity = {-1, 0.1, 0.05};
    scene.colliders[1].angular_velocity = {1, -0.4, 0.6};
    Bodies run(scene);
    const Sums before = sums_of(run);
    run.frames(60);
    const Sums after = sums_of(run);
    EXPECT_GT(length(run.body(0).momentum), 0.1) << "they meet";
    expect_near(after.momentum, before.momentum, 1e-6, "momentum");
    expect_near(after.angular, before.angular, 1e-6, "angular momentum");
    EXPECT_LT(after.kinetic, before.kinetic);
}

/// Two balls fly at a sheet that nothing holds, without gravity, one behind the other: cloth and bodies together keep
/// their momenta.
class BallsAndSheet : public testing::TestWithParam<SolverMethod> {};

TEST_P(BallsAndSheet, KeepTheirMomentum) {
    SceneDescription scene = by_method(level_sheet(0, 0), GetParam(), 16);
    scene.gravity = {0, 0, 0};
    scene.colliders = {ball({0.03, 0.12, 0.02}, 0.1, 0.3), ball({0.05, 0.45, 0.01}, 0.08, 0.3)};
    scene.colliders[0].velocity = {0.1, -0.5, 0};
    scene.colliders[1].velocity = {0, -2, 0.1};
    Bodies run(scene);
    const Sums before = sums_of(run);
    run.frames(40);
    const auto [of_cloth, turning] = test::momenta(run);
    EXPECT_GT(length(of_cloth), 0.02 * length(before.momentum)) << "they meet";
    expect_near(plus(of_cloth, sums_of(run).momentum), before.momentum,
                1e-4 * length(of_cloth) / length(before.momentum), "momentum");
}

/// A bob on the end of a strip swings: the pins bear what changes the momentum of strip and bob beside their weight.
TEST_P(BallsAndSheet, ABobOnAStripSwingsByItsForces) {
    SceneDescription scene = by_method(test::sheet(5, 21, 0.2, 1, 8), GetParam(), 32);
    Cloth& strip = scene.cloths[0];
    strip.placement = {{-0.1, 2, 0}, {1, 0, 0}, {0, -0.9, 0.43589}};
    strip.pins = {test::pin_box(0, 0, 4, 0), test::pin_box(0, 20, 4, 20)};
    // The far end is held too, so that the strip is a hammock with a bob in it.
    scene.colliders = {ball({0, 1.72, 0.24}, 0.06, 0.3)};
    strip.stiffness = {false, 2000, 100, 0};
    Bodies run(scene);
    const auto whole = [&] { return plus(test::momenta(run).first, sums_of(run).momentum); };
    run.frames(1);
    const Vec3 first = whole();
    Vec3 given{};
    double exchanged = 0;
    for (int frame = 2; frame <= 60; ++frame) {
        run.frames(1);
        const Vec3 held = times(run.frame_time(), plus(run.force("pins_0"), run.force("pins_1")));
        const Vec3 weight{0, -9.81 * run.frame_time() * (run.statistics().mass + 0.3), 0};
        given = plus(given, plus(held, weight));
        exchanged += length(held) + length(weight);
    }
    const double off = length(minus(minus(whole(), first), given));
    std::printf("[ measured ] momentum off by %.1e of what is exchanged\n", off / exchanged);
    EXPECT_LT(off, 1e-4 * exchanged);
}

INSTANTIATE_TEST_SUITE_P(Methods, BallsAndSheet, testing::ValuesIn(test::all_methods),
                         [](const auto& method) { return std::string(named(method.param).name); });

}  // namespace
}  // namespace drape
