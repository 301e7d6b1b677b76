#include "passes/force_pass.h"

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration force_descriptors[] = {
    image_read(0, "position_in"),          image_write(1, "position_out"),
    image_read(2, "displacement_in"),      image_write(3, "displacement_out"),
    image_read(4, "position_rest_in"),     image_write(5, "position_rest_out"),
    image_read(6, "displacement_rest_in"), image_write(7, "displacement_rest_out"),
    image_read(8, "wind_force"),  // the windy variant only
};
const vulkan::ShaderInterface calm{"force.comp", std::span(force_descriptors).first(8), &layouts::force_push};
const vulkan::ShaderInterface windy{"force_wind.comp", force_descriptors, &layouts::force_push};

constexpr vulkan::DescriptorDeclaration advance_descriptors[] = {
    image_read(0, "position_in"),
    image_write(1, "position_out"),
    image_read(2, "displacement"),
    image_read(3, "position_rest_in"),
    image_write(4, "position_rest_out"),
    image_write(5, "displacement_out"),  // the variant that returns from the spare images only
};
const vulkan::ShaderInterface advance_shader{"advance.comp", std::span(advance_descriptors).first(5),
                                             &layouts::grid_push};
const vulkan::ShaderInterface advance_home{"advance_home.comp", advance_descriptors, &layouts::grid_push};

}  // namespace

void add_force(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const bool wind = state.wind_force.valid();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(wind ? windy : calm, {{0, advances}});
    graph.add_pass(
        state.step_name("force", step),
        [&](graph::PassSetup& setup) {
            update(setup, state.position, 0, 1);
            update(setup, state.displacement, 2, 3);
            update(setup, state.position_rest, 4, 5);
            update(setup, state.displacement_rest, 6, 7);
            if (wind) setup.read(state.wind_force, graph::Access::compute_read, 8);
        },
        [&pipeline, push = state.model->force](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

void add_advance(graph::Graph& graph, PipelineCache& pipelines, ClothState& state) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(state.away ? advance_home : advance_shader);
    graph.add_pass(
        state.pass_name("advance", "simulate"),
        [&](graph::PassSetup& setup) {
            graph::Handle& home = state.away ? state.position_spare : state.position;
            setup.read(state.position, graph::Access::compute_read, 0);
            home = setup.write(home, graph::Access::compute_write, 1);
            setup.read(state.displacement, graph::Access::compute_read, 2);
            update(setup, state.position_rest, 3, 4);
            if (state.away)
                state.displacement_spare = setup.write(state.displacement_spare, graph::Access::compute_write, 5);
        },
        [&pipeline, push = glsl::GridPush{state.model->grid.size()}](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
    if (state.away) state.turn();
}

}  // namespace drape
