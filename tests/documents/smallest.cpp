// Simulates one substep of a cloth on the device and reads it back, with the engine's rooms alone.
#include <cstdio>

#include "cloth/simulation_model.h"
#include "graph/executor.h"
#include "solver/cloth_solver.h"
#include "solver/host_inputs.h"
#include "solver/readback_pass.h"
#include "solver/state_transfer.h"
#include "vulkan/instance.h"

int main() try {
    using namespace drape;

    // A scene: a level sheet of 17 x 17 particles and 1 m x 1 m whose first row is held. A frame is 1/60 s.
    Cloth sheet{.name = "sheet", .grid = {17, 17}, .size = {1, 1}};
    sheet.placement = {.origin = {0, 1, 0}, .u = {1, 0, 0}, .v = {0, 0, 1}};
    sheet.pins = {{.particles = {.first = {0, 0}, .last = {16, 0}}}};
    SceneDescription scene;
    scene.cloths = {sheet};
    scene.solver.method = SolverMethod::line;
    scene.solver.substeps = 1;

    // The device, which knows nothing of cloth, and the model, which knows nothing of Vulkan.
    const vulkan::Instance instance({});
    const vulkan::Device device(instance, "");
    const SimulationModel model(scene);

    // The graph: the solver declares the cloth's images and adds the passes of a frame; the plan has their barriers.
    ClothSolver solver(device, model);
    graph::Graph graph;
    solver.declare(graph, {});
    solver.add_simulation(graph);
    solver.add_readback(graph, Field::position, "positions");
    const graph::Plan plan = graph::make_plan(graph);

    // The memory that the plan needs, the start of the cloth in it, and the commands, recorded once.
    const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph, &plan}};
    const graph::ResourcePool pool(device, plans);
    upload_start(solver.layout(), pool);
    const graph::RecordedPlan recorded(graph, plan, pool, graph::TimestampMode::none);
    vulkan::FrameSlots slots(device);

    // Frame 1 in slot 0: the host writes its inputs, the device works, the host reads x y z w of each particle.
    write_inputs(solver.layout(), pool, 0, 1, model);
    slots.submit(0, recorded.commands(0));
    slots.wait(0);
    const std::span<const float> positions = read_back(solver.layout(), pool, 0, "positions")[0];
    const float* last = &positions[4 * 288];
    std::printf("%zu passes; the free edge fell by %.2f mm\n", plan.passes.size(), 1000 * (1 - last[1]));
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
