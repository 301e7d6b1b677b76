#include "passes/explicit_pass.h"

namespace drape {

void add_explicit_step(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const bool wind = state[Field::wind_force].valid();
    const auto& push = step.push<glsl::ExplicitPush>();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0, has_shear = push.relative_stiffness.z > 0 ? 1 : 0,
                        has_bend = push.twist > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("explicit.comp",
                                           {{"masked", state.masked()}, {"wind", wind}, {"buffered", state.buffered}}),
                      {{"advance", advances}, {"has_shear", has_shear}, {"has_bend", has_bend}});
    graph.add_pass(
        state.step_name("explicit step", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position_in");
            state[Field::position_spare] =
                setup.write(state[Field::position_spare], graph::Access::compute_write, "position_out");
            setup.read(state[Field::displacement], graph::Access::compute_read, "displacement_in");
            state[Field::displacement_spare] =
                setup.write(state[Field::displacement_spare], graph::Access::compute_write, "displacement_out");
            update(setup, state[Field::position_remainder], "position_remainder");
            update(setup, state[Field::displacement_remainder], "displacement_remainder");
            if (wind) setup.read(state[Field::wind_force], graph::Access::compute_read, "wind_force");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
        },
        [&pipeline, push](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
    state.turn();
}

}  // namespace drape
