#include "solver/tension_pass.h"

namespace drape {

void add_tension(graph::Graph& graph, Pipelines& pipelines, ClothState& state) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("tension.comp");
    graph.add_pass(
        state.pass_name("tension", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            setup.read(state[Field::displacement], graph::Access::compute_read, "displacement");
            state[Field::tension_row] =
                setup.write(state[Field::tension_row], graph::Access::compute_write, "tension_row");
            state[Field::tension_column] =
                setup.write(state[Field::tension_column], graph::Access::compute_write, "tension_column");
        },
        [&pipeline, push = *state.model->plan.gathered_tension, count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y), count);
        });
}

}  // namespace drape
