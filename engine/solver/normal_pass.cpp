#include "solver/normal_pass.h"

namespace drape {

void add_normals(graph::Graph& graph, Pipelines& pipelines, ClothState& state) {
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("normal.comp", {{"masked", state.masked()}}));
    graph.add_pass(
        state.pass_name("normals", "normals"),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            state[Field::normal] = setup.write(state[Field::normal], graph::Access::compute_write, "normal");
            if (state.masked()) setup.read(state[Field::cells], graph::Access::compute_read, "cells");
        },
        [&pipeline, push = glsl::GridPush{state.model->grid.size()}, count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y), count);
        });
}

}  // namespace drape
