#include "solver/tether_pass.h"

namespace drape {

void add_tether(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("tether.comp", {{"buffered", state.buffered}}),
                      {{"strip_length", pipelines.strip_length()}});
    graph.add_pass(
        state.step_name("tethers", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            setup.read(state[Field::tethers], graph::Access::compute_read, "tethers");
        },
        [&pipeline, push = glsl::GridPush{state.model->grid.size()},
         over = pipelines.over_strips(state.model->grid.size())](graph::PassContext& context) {
            context.dispatch(pipeline, push, over[0], over[1]);
        });
}

}  // namespace drape
