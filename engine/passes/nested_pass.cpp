#include "passes/nested_pass.h"

#include "passes/step_dispatch.h"

namespace drape {

void add_nested(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const ClothModel& model = *state.model;
    const auto& push = step.push<glsl::NestedPush>();
    const bool sheared = push.rest_length.z > 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(vulkan::variant_name(
        "nested.comp", {{"masked", state.masked()}, {"sheared", sheared}, {"buffered", state.buffered}}));
    const auto pin_count =
        static_cast<std::uint32_t>(model.plan.nested_table[static_cast<std::size_t>(push.first_pin)].z);
    const StepDispatch dispatch(state, step, pipeline, pin_count * static_cast<std::uint32_t>(glsl::nested_group_width),
                                1);
    graph.add_pass(
        state.step_name("nested sweeps", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            setup.read(state[Field::nested_sweeps], graph::Access::compute_read, "table");
            update(setup, state[Field::nested_rows], "rows");
            update(setup, state[Field::tension_row], "tension_row");
            update(setup, state[Field::tension_column], "tension_column");
            if (sheared) {
                update(setup, state[Field::tension_shear_down_right], "tension_down_right");
                update(setup, state[Field::tension_shear_down_left], "tension_down_left");
            }
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            setup.read(state[Field::line_control], graph::Access::compute_read, "control");
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
