#include "passes/tension_pass.h"

namespace drape {

void add_tension(graph::Graph& graph, PipelineCache& pipelines, ClothState& state) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("tension.comp");
    graph.add_pass(
        state.pass_name("tension", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, "position");
            setup.read(state.displacement, graph::Access::compute_read, "displacement");
            state.tension[0] = setup.write(state.tension[0], graph::Access::compute_write, "tension_row");
            state.tension[1] = setup.write(state.tension[1], graph::Access::compute_write, "tension_column");
        },
        [&pipeline, push = *state.model->plan.gathered_tension](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

}  // namespace drape
