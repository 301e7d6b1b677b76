// Bodies that cloth moves, on the device, equal the twin's bit for bit (lavapipe).
#include <gtest/gtest.h>

#include <algorithm>

#include "support/sewn_scenes.h"
#include "twin_comparison.h"
#include "world/mass_properties.h"

namespace drape {
namespace {

using test::compare;

class TwinBodiesTest : public testing::TestWithParam<SolverMethod> {};

/// Everything at once, and some colliders of each kind that may have one have a mass.
SceneDescription with_bodies(SolverMethod method) {
    SceneDescription scene = test::everything();
    scene.solver.method = method;
    for (const std::size_t k : {0u, 2u, 3u, 5u}) {
        Collider& body = scene.colliders[k];
        body.path = {};
        body.mass = 0.4 + 0.1 * static_cast<double>(k);
        body.velocity = {0.1, 0.2, 0.3};
        body.angular_velocity = {1, -2, 0.5};
    }
    scene.colliders[2].inertia = {0.004, 0.005, 0.006};
    return scene;
}

TEST_P(TwinBodiesTest, EverythingAtOnce) { compare(with_bodies(GetParam())); }

TEST_P(TwinBodiesTest, TwoClothsInGravityThatChanges) {
    SceneDescription scene = with_bodies(GetParam());
    scene.gravity_keys = {{0.02, {0, -9.81, 0}}, {0.25, {-4, 3, 0}}};
    scene.forces = true;
    test::add_second_cloth(scene);
    compare(scene);
}

TEST_P(TwinBodiesTest, BesideContactBetweenLayers) {
    SceneDescription scene = with_bodies(GetParam());
    scene.cloths[0].grid = {13, 11};
    scene.cloths[0].pins = {test::pin_box(0, 0, 2, 0)};
    scene.cloths[0].self_collision.emplace();
    compare(scene);
}

/// Cloths that are simulated together lie in one image, and the bodies with the first.
TEST_P(TwinBodiesTest, ClothsTogether) {
    SceneDescription scene = with_bodies(GetParam());
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].placement.origin[1] += 0.1;
    compare(scene);
}

/// Bodies of every kind fall onto each other, obstacles and the cloth, one of them light.
TEST_P(TwinBodiesTest, AHeapMeets) {
    SceneDescription scene = with_bodies(GetParam());
    for (Collider& each : scene.colliders) {
        if (each.path.moves() || special(each.shape).plane) continue;
        each.mass = 0.5;
        each.velocity = {0, -1, 0.2};
        each.angular_velocity = {1, -2, 0.5};
    }
    Collider box{Box{{0.05, 0.3, 0}, {0.08, 0.06, 0.1}}}, other{Box{{0.06, 0.44, 0.02}, {0.05, 0.07, 0.06}}};
    Collider rod{Capsule{{-0.2, 0.6, 0}, {0.2, 0.62, 0.1}, {0.05, 0.04}}}, light{Sphere{{0, 0.8, 0.05}, 0.08}};
    for (Collider* const each : {&box, &other, &rod}) each->mass = 0.4;
    light.mass = 0.2 * covering_mass(scene, light.shape);
    scene.colliders.insert(scene.colliders.end(), {box, other, rod, light});
    std::ranges::stable_sort(scene.colliders, {}, &Collider::kind);
    compare(scene);
}

TEST_P(TwinBodiesTest, BesideSeams) {
    if (GetParam() == SolverMethod::explicit_steps) GTEST_SKIP() << "refused: seam_rules_test";
    SceneDescription scene = test::three_panels(GetParam());
    for (Collider& body : scene.colliders) body.mass = 0.6;
    compare(scene);
}

TEST_P(TwinBodiesTest, ActionsPushAndThrowThem) {
    const auto act = [](SimulationModel& model, std::uint32_t frame) {
        for (Body& body : model.bodies.front().bodies) {
            body.acts.force = {0.1, -2, 0.3};
            body.acts.moment = {0.01, 0, -0.02 * frame};
            body.acts.impulse = {0, 0.02 * frame, 0};
            body.acts.twist = {0, 0.001, 0};
            body.acts.sets = frame % 3 == 2 && body.number % 2 == 1;
            body.acts.velocity = {0, -0.3, 0.1 * frame};
            body.acts.turning = {1, 2, -3};
        }
    };
    compare(with_bodies(GetParam()), {.bodies = true, .acts = true}, test::gpu().device, {.drawing = true}, {}, act);
}

INSTANTIATE_TEST_SUITE_P(Methods, TwinBodiesTest,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& method) { return std::string(named(method.param).name); });

}  // namespace
}  // namespace drape
