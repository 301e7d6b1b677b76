// Cloths that one dispatch simulates together equal their twins bit for bit (lavapipe), and so their being alone.
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;
using test::DeviceRun;
using test::everything;

/// Three of one kind, pinned in three ways, and another in their midst.
SceneDescription several(SolverMethod method) {
    SceneDescription scene = everything();
    scene.solver.method = method;
    Cloth cloth = scene.cloths[0];
    cloth.name = "other";
    cloth.grid = {24, 13};
    cloth.pins = {test::pin_top(cloth)};
    scene.cloths.push_back(cloth);
    for (const char* name : {"second", "third"}) {
        cloth = scene.cloths[0];
        cloth.name = name;
        cloth.placement.origin[1] += 0.1 * static_cast<double>(scene.cloths.size());
        cloth.velocity = {0, -0.5, 0};
        cloth.pins.push_back(test::pin_box(7, 9, 9, 9));
        cloth.pins.back().path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0, 0.05, 0.1}, {}}};
        scene.cloths.push_back(cloth);
    }
    return scene;
}

/// Whether the device has them in one image.
bool are_together(const SceneDescription& scene, const Kernels& kernels) {
    const SimulationModel model(scene);
    const DeviceRun run(test::gpu().device, model, {}, kernels);
    return run.pool().has("sheet and 2 more/position") && run.pool().has("third/position");
}

TEST(TwinTogetherTest, Lines) {
    const SceneDescription scene = several(SolverMethod::line);
    EXPECT_FALSE(are_together(scene, Kernels()));
    for (const Kernels& kernels : test::kernel_sets(test::gpu().device, SimulationModel(scene)))
        EXPECT_EQ(are_together(scene, kernels), kernels.has(Kernel::buffer_store));
    compare(scene);
}

TEST(TwinTogetherTest, LinesOfSecondOrderThatBendAndHaveHoles) {
    SceneDescription scene = several(SolverMethod::line);
    scene.colliders = {};
    for (Cloth& cloth : scene.cloths) {
        cloth.stiffness.bend = 1e-4;
        cloth.holes = {{{10, 5}, {17, 10}}};
        cloth.pins.resize(1);
    }
    compare(scene);
}

TEST(TwinTogetherTest, Explicit) { compare(several(SolverMethod::explicit_steps)); }

TEST(TwinTogetherTest, ExplicitStreams) {
    SceneDescription scene = several(SolverMethod::explicit_steps);
    scene.colliders = {};
    scene.wind = {};
    for (Cloth& cloth : scene.cloths) cloth.pins = {test::pin_top(cloth)};
    compare(scene);
}

TEST(TwinTogetherTest, OneMovesItsPins) {
    for (const SolverMethod method : {SolverMethod::explicit_steps, SolverMethod::line}) {
        SceneDescription scene = several(method);
        scene.colliders = {};
        scene.wind = {};
        for (std::size_t k = 1; k < scene.cloths.size(); ++k) scene.cloths[k].pins = {test::pin_top(scene.cloths[k])};
        compare(scene);
    }
}

TEST(TwinTogetherTest, Relaxed) {
    SceneDescription scene = several(SolverMethod::relax);
    for (Cloth& cloth : scene.cloths) cloth.stiffness.bend = 1e-4;
    scene.solver.iterations = 2;
    compare(scene);
}

}  // namespace
}  // namespace drape
