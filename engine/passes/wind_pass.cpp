#include "passes/wind_pass.h"

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {
    image_read(0, "position"),
    image_read(1, "displacement"),
    image_write(2, "wind_force"),
    vector_buffer_read(3, "Wind", sizeof(glsl::vec4)),
    image_read(4, "cells", VK_FORMAT_R32_UINT),  // the masked variant only
};
const vulkan::ShaderInterface whole{"wind.comp", std::span(descriptors).first(4), &layouts::wind_push};
const vulkan::ShaderInterface masked{"wind_masked.comp", descriptors, &layouts::wind_push};

}  // namespace

void add_wind(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const SceneInputs& inputs,
              const Step& step) {
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(state.model->masked ? masked : whole, {{0, advances}});
    glsl::WindPush push = state.model->wind;
    push.substep = static_cast<int>(step.substep);
    graph.add_pass(
        state.step_name("wind", step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            setup.read(state.displacement, graph::Access::compute_read, 1);
            state.wind_force = setup.write(state.wind_force, graph::Access::compute_write, 2);
            setup.read(inputs.wind, graph::Access::compute_read, 3);
            if (state.model->masked) setup.read(state.cells, graph::Access::compute_read, 4);
        },
        [&pipeline, push](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

}  // namespace drape
