#include "passes/tension_pass.h"

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {image_read(0, "position"), image_read(1, "displacement"),
                                                         image_write(2, "tension_row", VK_FORMAT_R32_SFLOAT),
                                                         image_write(3, "tension_column", VK_FORMAT_R32_SFLOAT)};
const vulkan::ShaderInterface interface { "tension.comp", descriptors, &layouts::tension_push };

}  // namespace

void add_tension(graph::Graph& graph, PipelineCache& pipelines, ClothState& state) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(interface);
    graph.add_pass(
        state.pass_name("tension", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            setup.read(state.displacement, graph::Access::compute_read, 1);
            state.tension[0] = setup.write(state.tension[0], graph::Access::compute_write, 2);
            state.tension[1] = setup.write(state.tension[1], graph::Access::compute_write, 3);
        },
        [&pipeline, push = state.model->tension](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

}  // namespace drape
