// The sums of a frame's impulses on the device equal the twin's bit for bit (lavapipe).
#include <gtest/gtest.h>

#include "support/self_contact_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;

SceneDescription telling_forces(SceneDescription scene, SolverMethod method) {
    scene.forces = true;
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

TEST_P(TwinForcesTest, ClothsThatMeetOnABall) {
    const bool is_explicit = GetParam() == SolverMethod::explicit_steps;
    compare(telling_forces(test::layers(GetParam(), is_explicit ? 30 : 10), GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Methods, TwinForcesTest,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& each) { return std::string(named(each.param).name); });

}  // namespace
}  // namespace drape
