// The sums of a frame's impulses on the device equal the twin's bit for bit (lavapipe).
#include <gtest/gtest.h>

#include "support/loads.h"
#include "support/self_contact_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;

SceneDescription telling_forces(SceneDescription scene, SolverMethod method) {
    scene.forces = scene.worst_forces = scene.force_fields = true;
    scene.solver.method = method;
    return scene;
}

class TwinForcesTest : public testing::TestWithParam<SolverMethod> {};

TEST_P(TwinForcesTest, EverythingAtOnce) {
    SceneDescription scene = telling_forces(test::everything(), GetParam());
    scene.gravity_keys = {{0.02, {0, -9.81, 0}}, {0.25, {-4, 3, 0}}};
    compare(scene);
}

TEST_P(TwinForcesTest, SeveralPinsOfClothsWithHolesInFlight) {
    SceneDescription scene = telling_forces(test::everything(), GetParam());
    scene.wind = {};
    scene.colliders.clear();
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}};
    scene.cloths[0].stiffness.compression = 0.1;
    test::add_second_cloth(scene);
    compare(scene);
}

/// Particles have frictions and thicknesses of their own, beside the sums of what colliders give them.
TEST_P(TwinForcesTest, SkinsThatDiffer) {
    SceneDescription scene = telling_forces(test::everything(), GetParam());
    Cloth& cloth = scene.cloths[0];
    for (std::uint32_t particle = 0; particle < cloth.grid[0] * cloth.grid[1]; ++particle) {
        cloth.particle_friction.push_back(static_cast<float>(particle % 7) / 4.0f);
        cloth.particle_thickness.push_back(static_cast<float>(particle % 5) / 4.0f);
    }
    compare(scene);
}

std::vector<Load> some_loads() {
    std::vector<Load> loads{test::pull({{2, 2}, {9, 7}}, Vec3{0.3, -0.2, 0.1}),
                            test::pull({{9, 7}, {9, 7}}, std::vector<VectorKey>{{0, {0, 0, 0}}, {0.1, {0, 0, 0.2}}}),
                            test::press({{0, 0}, {9, 9}}, 3)};
    return loads;
}

TEST_P(TwinForcesTest, LoadsInTheWind) {
    SceneDescription scene = telling_forces(test::everything(), GetParam());
    scene.gravity_keys = {{0.02, {0, -9.81, 0}}, {0.25, {-4, 3, 0}}};
    scene.cloths[0].loads = some_loads();
    compare(scene);
}

TEST_P(TwinForcesTest, LoadsOfOneOfTwoClothsWithHoles) {
    SceneDescription scene = telling_forces(test::everything(), GetParam());
    scene.wind = {};
    scene.colliders.clear();
    scene.cloths[0].holes = {{{4, 3}, {8, 8}}};
    test::add_second_cloth(scene);
    scene.cloths[1].loads = some_loads();
    compare(scene);
}

TEST_P(TwinForcesTest, ClothsThatMeetOnABall) {
    const bool is_explicit = GetParam() == SolverMethod::explicit_steps;
    compare(telling_forces(test::layers(GetParam(), is_explicit ? 30 : 10), GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Methods, TwinForcesTest,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& each) { return std::string(named(each.param).name); });

}  // namespace
}  // namespace drape
