#include "passes/tether_pass.h"

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {image_read(0, "position"), image_read(1, "displacement_in"),
                                                         image_write(2, "displacement_out"),
                                                         struct_buffer_read(3, "Tethers", &layouts::particle_tethers)};
const vulkan::ShaderInterface shader{"tether.comp", descriptors, &layouts::grid_push};

}  // namespace

void add_tether(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(shader);
    graph.add_pass(
        state.step_name("tethers", step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            update(setup, state.displacement, 1, 2);
            setup.read(state.tethers, graph::Access::compute_read, 3);
        },
        [&pipeline, push = glsl::GridPush{state.model->grid.size()}](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

}  // namespace drape
