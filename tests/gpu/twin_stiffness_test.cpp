// Stiffness that keys change: the device has the twin's bits by every method and kernel, and what hangs on it stretches
// as a chain of springs does.
#include <gtest/gtest.h>

#include <cmath>

#include "control/sleep.h"
#include "device_run.h"
#include "gpu_test.h"
#include "support/sheets.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;

constexpr SolverMethod changed_methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

/// Keys that change in the midst of frames, one of them at once.
void weaken(Cloth& cloth) { cloth.stiffness_keys = {{0.004, 1}, {0.02, 0.25}, {0.021, 0.9}, {0.1, 0.125}}; }

TEST(TwinStiffnessTest, EveryMethod) {
    for (const SolverMethod method : changed_methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        scene.cloths[0].stiffness.bend = 1e-4;
        weaken(scene.cloths[0]);
        compare(scene);
        if (method == SolverMethod::line) {
            scene.colliders = {};  // of second order
            compare(scene);
        }
    }
}

TEST(TwinStiffnessTest, ClothThatMeetsItself) {
    SceneDescription scene = test::everything_in_lines();
    weaken(scene.cloths[0]);
    scene.cloths[0].self_collision.emplace();
    compare(scene);
}

TEST(TwinStiffnessTest, OneOfTwoClothsAlike) {
    SceneDescription scene = test::everything();
    scene.cloths = {scene.cloths[0], scene.cloths[0]};
    scene.cloths[1].name = "other";
    scene.cloths[1].placement.origin[0] += 5;
    weaken(scene.cloths[1]);
    compare(scene);
}

/// A strip of one row of cells hangs from its top. Damping brings it to rest with the stiffness of each time.
SceneDescription hanging_strip() {
    SceneDescription scene = test::sheet(2, 9, 0.1, 0.8, 16);
    scene.solver.method = SolverMethod::line;
    scene.time.frame_count = 241;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 400, 0, 0};
    cloth.damping = 12;
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, -1, 0}};
    cloth.pins = {test::pin_top(cloth)};
    cloth.stiffness_keys = {{1.9, 1}, {2.1, 0.25}};
    return scene;
}

/// Length over that at rest of a column of springs at rest: spring j of n bears what is below it, (n - j + 1/2) rows of
/// mass sigma dy per width.
double stretch_of_chain(const Cloth& cloth, double factor) {
    const int n = static_cast<int>(cloth.grid[1]) - 1;
    const double dy = cloth.size[1] / n;
    double longer = 0;
    for (int j = 1; j <= n; ++j)
        longer += cloth.areal_density * 9.81 * dy * (n - j + 0.5) / (factor * cloth.stiffness.stretch.weft) * dy;
    return longer;
}

TEST(TwinStiffnessTest, AStripHangsAsAChainOfSprings) {
    const SceneDescription scene = hanging_strip();
    const SimulationModel model(scene);
    test::DeviceRun run(test::gpu().device, model);
    const auto lowest = [&] { return -double(run.texels(0, Field::position).back().y) - 0.8; };
    for (std::uint32_t frame = 1; frame <= 114; ++frame) run.run_frame(frame);
    const double before = stretch_of_chain(scene.cloths[0], 1), after = stretch_of_chain(scene.cloths[0], 0.25);
    EXPECT_NEAR(lowest(), before, 1e-3 * before);
    for (std::uint32_t frame = 115; frame <= 240; ++frame) run.run_frame(frame);
    EXPECT_NEAR(lowest(), after, 1e-3 * after);
}

TEST(TwinStiffnessTest, NothingSleepsWhileItChanges) {
    const SimulationModel model(hanging_strip());
    EXPECT_TRUE(quiet(model, 100));
    EXPECT_FALSE(quiet(model, 120));
    EXPECT_TRUE(quiet(model, 130));
}

}  // namespace
}  // namespace drape
