// Gas on the device equals its twin bit for bit (lavapipe).
#include "support/gas_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

class TwinGasTest : public ::testing::TestWithParam<SolverMethod> {};

/// A cushion that is blown up as it falls.
SceneDescription falling(SolverMethod method, std::uint32_t n, double bulge) {
    SceneDescription scene = test::gas_cushion(method, n, test::substep_count, bulge, true);
    scene.gravity = {0, -9.81, 0};
    test::blow_up(scene, 0.005, 0.1);
    return scene;
}

TEST_P(TwinGasTest, ACushion) { test::compare(falling(GetParam(), 17, 0.02)); }

TEST_P(TwinGasTest, ACushionOfSeveralWorkgroupsThatTellsForces) {
    SceneDescription scene = falling(GetParam(), 37, 0.02);
    scene.forces = true;
    scene.cloths[0].loads = {{.particles = {{0, 0}, {36, 36}}, .pressure = 3}};
    scene.wind.velocity = {1, 0.3, -2};
    test::compare(scene);
}

TEST_P(TwinGasTest, AFlatStartOnColliders) {
    SceneDescription scene = falling(GetParam(), 13, 0);
    scene.gas[0].outside = ClothSide::back;
    scene.gas[0].volume_keys.front().value = 0;
    scene.colliders = {{Sphere{{0.05, 0.05, 0}, 0.2}, 0.3}};
    scene.gravity_keys = {{0, {0, -3, 0}}, {0.05, {0.4, -12, 0}}};
    scene.cloths[0].damping = 0.7;
    test::compare(scene);
}

TEST_P(TwinGasTest, ACushionThatMeetsItselfOnAFloor) {
    SceneDescription scene = falling(GetParam(), 13, 0.02);
    scene.colliders = {{Plane{{0, 1, 0}, 0.29}, 0.3}};
    for (Cloth& cloth : scene.cloths) cloth.self_collision = SelfCollision{0.005, {}};
    test::compare(scene);
}

TEST_P(TwinGasTest, UnlikeSides) {
    SceneDescription scene = falling(GetParam(), 9, 0.02);
    Cloth& fine = scene.cloths[1];
    SceneDescription finer = falling(GetParam(), 17, 0.02);
    fine.grid = {17, 17};
    fine.start = finer.cloths[1].start;
    test::compare(scene);
}

INSTANTIATE_TEST_SUITE_P(Methods, TwinGasTest,
                         ::testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& method) { return std::string(named(method.param).name); });

}  // namespace
}  // namespace drape
