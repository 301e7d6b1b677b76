// Cloths that one dispatch simulates together equal their twins bit for bit (lavapipe), and so their being alone.
#include "solver/kernel_choice.h"
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

/// By kernels for GPUs; software takes long for those of lines, so there are a few substeps.
void compare_by(const Kernels& kernels, SceneDescription scene) {
    if (scene.solver.method != SolverMethod::explicit_steps) scene.solver.substeps = 2;
    compare(scene, {}, test::gpu().device, {.drawing = true}, kernels);
}

/// Whether the device has them in one image.
bool are_together(const SceneDescription& scene, const Kernels& kernels) {
    const SimulationModel model(scene);
    const DeviceRun run(test::gpu().device, model, {}, kernels);
    return run.pool().has("sheet and 2 more/position") && !run.pool().has("third/position");
}

/// Gives every cloth numbers of its own.
SceneDescription unlike(SceneDescription scene) {
    double by = 1;
    for (Cloth& cloth : scene.cloths) {
        cloth.size = {cloth.size[0] * by, cloth.size[1] / by};
        cloth.areal_density *= by;
        cloth.stiffness.stretch *= 1 / (by * by);
        cloth.stiffness.shear *= by;
        cloth.stiffness.bend *= by;
        cloth.stiffness.compression /= by;
        cloth.damping *= by * by;
        cloth.friction /= by;
        cloth.thickness *= by;
        by += 0.25;
    }
    return scene;
}

TEST(TwinTogetherTest, Lines) {
    const SceneDescription scene = several(SolverMethod::line);
    EXPECT_GT(std::ranges::count(frame_steps(SimulationModel(scene)), StepKind::collider_edges, &Step::kind), 0);
    for (const SceneDescription& each : {scene, unlike(scene)}) {
        for (const KernelSet& set : all_kernel_sets) EXPECT_TRUE(are_together(each, set.kernels)) << set.name;
        compare(each);
        compare_by(cyclic_kernels, each);
        compare_by(parts_kernels, each);
    }
}

TEST(TwinTogetherTest, LinesOfSecondOrderThatBendAndHaveHoles) {
    SceneDescription scene = several(SolverMethod::line);
    scene.colliders = {};
    for (Cloth& cloth : scene.cloths) {
        cloth.stiffness.bend = 1e-4;
        cloth.holes = {{{10, 5}, {17, 10}}};
        cloth.pins.resize(1);
    }
    scene = unlike(scene);
    compare(scene);
    compare_by(cyclic_kernels, scene);
}

TEST(TwinTogetherTest, LonePinsInSeveralPlacesAndTethers) {
    SceneDescription scene = test::lone_pins();
    scene.solver.substeps = 1;
    scene.solver.tethers = true;
    scene.cloths[0].grid = {50, 52};
    scene.cloths[0].pins.clear();
    Pin released = test::pin_box(49, 0, 49, 0);
    released.release = 0.11;
    for (const std::uint32_t row : {0u, 30u, 51u}) {
        Cloth cloth = scene.cloths[0];
        cloth.name = "sheet " + std::to_string(row);
        cloth.placement.origin[1] += row;
        cloth.pins = {test::pin_box(row / 2, row, row / 2, row), released};
        scene.cloths.push_back(cloth);
    }
    scene.cloths.erase(scene.cloths.begin());
    scene = unlike(scene);
    compare(scene);
    compare_by(cyclic_kernels, scene);
}

TEST(TwinTogetherTest, Explicit) {
    const SceneDescription scene = unlike(several(SolverMethod::explicit_steps));
    compare(scene);
    compare_by(tile_kernels, scene);
}

TEST(TwinTogetherTest, ExplicitStreams) {
    SceneDescription scene = several(SolverMethod::explicit_steps);
    scene.colliders = {};
    scene.wind = {};
    for (Cloth& cloth : scene.cloths) cloth.pins = {test::pin_top(cloth)};
    scene = unlike(scene);
    compare(scene);
    compare_by(tile_kernels, scene);
    for (Cloth& cloth : scene.cloths) cloth.grid = {21, 30};
    compare_by(tile_kernels, scene);
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
    scene = unlike(scene);
    compare(scene);
    compare_by(tile_kernels, scene);
}

/// Cloths that bend, blown on, holed and tethered, whose pins stay, move or let go, above a ball.
SceneDescription alike(SolverMethod method, std::size_t count) {
    SceneDescription scene = test::thrown_sheet({50, 49}, 3);
    scene.solver.method = method;
    scene.solver.tethers = true;
    scene.wind.velocity = {2, 0.5, -1};
    scene.colliders = {{Sphere{{0, -3, 0}, 0.5}}};
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.bend = 1e-4;
    cloth.holes = {{{10, 5}, {17, 10}}};
    Pin moving = test::pin_box(49, 0, 49, 0), released = test::pin_box(0, 48, 0, 48);
    moving.path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0.1, 0.05, 0}, {}}};
    released.release = 0.11;
    cloth.pins = {test::pin_box(0, 0, 0, 0), moving, released};
    for (std::size_t k = 1; k < count; ++k) {
        scene.cloths.push_back(scene.cloths[0]);
        scene.cloths[k].name = "sheet " + std::to_string(k);
        scene.cloths[k].placement.origin[1] += static_cast<double>(k);
    }
    return scene;
}

/// A frame that does everything.
graph::Graph frame_of(const SceneDescription& scene, const Kernels& kernels) {
    const SimulationModel model(scene);
    ClothSolver solver(test::gpu().device, model, kernels);
    graph::Graph graph;
    solver.declare(graph, {.drawing = true, .statistics = true});
    solver.add_simulation(graph);
    solver.add_normals(graph);
    solver.add_readback(graph, Field::position, "position");
    solver.add_readback(graph, Field::normal, "normal");
    solver.add_statistics(graph);
    return graph;
}

std::size_t passes_of_frame(const SceneDescription& scene, const Kernels& kernels) {
    return graph::make_plan(frame_of(scene, kernels)).passes.size();
}

TEST(TwinTogetherTest, ConstantsOfEachAreThereOncePerFrame) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps, SolverMethod::relax}) {
        SceneDescription scene = unlike(alike(method, 2));
        const std::size_t of_three = frame_of(scene, {}).resources().size();
        scene.solver.substeps = 5;
        EXPECT_EQ(frame_of(scene, {}).resources().size(), of_three);
    }
}

TEST(TwinTogetherTest, TheirNumberChangesNoNumberOfPasses) {
    using enum StepKind;
    const std::vector<Step> steps = frame_steps(SimulationModel(alike(SolverMethod::line, 2)));
    for (const StepKind kind : {release, wind, pin, twist, nested, tether, collide})
        EXPECT_GT(std::ranges::count(steps, kind, &Step::kind), 0) << static_cast<int>(kind);
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps, SolverMethod::relax})
        for (const KernelSet& set : all_kernel_sets) {
            const std::size_t of_two = passes_of_frame(alike(method, 2), set.kernels);
            EXPECT_EQ(passes_of_frame(alike(method, 5), set.kernels), of_two) << set.name << " " << named(method).name;
            EXPECT_EQ(passes_of_frame(unlike(alike(method, 5)), set.kernels), of_two) << set.name << ", unlike";
        }
}

TEST(TwinTogetherTest, TheirNumberChangesNoNumberOfPassesAroundAttempts) {
    using enum StateStep;
    const SimulationModel two(alike(SolverMethod::automatic, 2)), five(alike(SolverMethod::automatic, 5));
    for (const StateStep step : {keep, restore, change_substep, remember, compare}) {
        std::vector<std::size_t> counts;
        for (const SimulationModel* model : {&two, &five}) {
            ClothSolver solver(test::gpu().device, *model);
            graph::Graph graph;
            solver.declare(graph, {});
            solver.add_attempt(graph, step);
            counts.push_back(graph::make_plan(graph).passes.size());
        }
        EXPECT_EQ(counts[0], counts[1]);
    }
}

TEST(TwinTogetherTest, EverythingThatTheirNumberMustNotChange) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps, SolverMethod::relax})
        for (const SceneDescription& each : {alike(method, 3), unlike(alike(method, 3))}) {
            compare(each);
            compare_by(method == SolverMethod::line ? cyclic_kernels : tile_kernels, each);
        }
}

}  // namespace
}  // namespace drape
