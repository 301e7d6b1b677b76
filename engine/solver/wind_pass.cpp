#include "solver/wind_pass.h"

namespace drape {

void add_wind(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
              const Step& step) {
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("wind.comp", {{"masked", state.masked()}, {"buffered", state.buffered}}),
        {{"advance", advances}, {"strip_rows", pipelines.strip_rows()}, {"strip_columns", pipelines.strip_columns()}});
    glsl::WindPush push = state.model->wind;
    push.substep = static_cast<int>(step.substep);
    graph.add_pass(
        state.step_name("wind", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            setup.read(state[Field::displacement], graph::Access::compute_read, "displacement");
            state[Field::wind_force] =
                setup.write(state[Field::wind_force], graph::Access::compute_write, "wind_force");
            setup.read(inputs.wind, graph::Access::compute_read, "wind");
            if (state.masked()) setup.read(state[Field::cells], graph::Access::compute_read, "cells");
        },
        [&pipeline, push, columns = pipelines.strip_columns(), rows = pipelines.strips_of(state.model->grid.rows()),
         count = state.count](graph::PassContext& context) {
            const std::uint32_t strips = (static_cast<std::uint32_t>(push.grid.x) + columns - 1) / columns;
            context.dispatch(pipeline, push, strips, rows, count);
        });
}

}  // namespace drape
