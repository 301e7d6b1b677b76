#include "passes/normal_pass.h"

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {
    image_read(0, "position"), image_write(1, "normal"),
    image_read(2, "cells", VK_FORMAT_R32_UINT),  // the masked variant only
};
const vulkan::ShaderInterface whole{"normal.comp", std::span(descriptors).first(2), &layouts::grid_push};
const vulkan::ShaderInterface masked{"normal_masked.comp", descriptors, &layouts::grid_push};

}  // namespace

void add_normals(graph::Graph& graph, PipelineCache& pipelines, ClothState& state) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(state.model->masked ? masked : whole);
    graph.add_pass(
        state.pass_name("normals", "normals"),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            state.normal = setup.write(state.normal, graph::Access::compute_write, 1);
            if (state.model->masked) setup.read(state.cells, graph::Access::compute_read, 2);
        },
        [&pipeline, push = glsl::GridPush{state.model->grid.size()}](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

}  // namespace drape
