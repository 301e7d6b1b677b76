#include "solver/nested_pass.h"

#include <algorithm>
#include <span>

#include "cloth/nested_sweeps.h"
#include "solver/step_dispatch.h"

namespace drape {

namespace {

/// Invocations of a workgroup. Where cores are few one subgroup is enough: others would only take turns with it at
/// every barrier. More where the default device would break off.
std::uint32_t group_width(const ClothState& state, const glsl::NestedPush& push, std::span<const glsl::ivec4> pins) {
    constexpr int subgroup = 8, most = glsl::nested_group_width;
    int width = state.buffered ? subgroup : most;
    const auto takes_too_many = [&](const glsl::ivec4& pin) {
        return nested_rounds(state.model->plan, push, {pin.x, pin.y}, width) > most_loop_rounds;
    };
    while (width < most && std::ranges::any_of(pins, takes_too_many)) width *= 2;
    return static_cast<std::uint32_t>(width);
}

bool is_sheared(const Step& step) { return step.push<glsl::NestedPush>().rest_length.z > 0; }

const vulkan::ComputePipeline& nested_pipeline(Pipelines& pipelines, const ClothState& state, const Step& step,
                                               std::span<const glsl::ivec4> pins) {
    if (step.reduced)
        return pipelines.get(
            vulkan::variant_name("nested_cyclic.comp", {{"masked", state.masked()}, {"sheared", is_sheared(step)}}));
    const std::uint32_t width = group_width(state, step.push<glsl::NestedPush>(), pins);
    return pipelines.get(
        vulkan::variant_name("nested.comp",
                             {{"masked", state.masked()}, {"sheared", is_sheared(step)}, {"buffered", state.buffered}}),
        {{vulkan::local_size_names[0], width}});
}

}  // namespace

void add_nested(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const ClothModel& model = *state.model;
    const auto& push = step.push<glsl::NestedPush>();
    const std::span<const glsl::ivec4> table =
        std::span(model.plan.nested_table).subspan(static_cast<std::size_t>(push.first_pin));
    const auto pin_count = static_cast<std::uint32_t>(table[0].z);
    const vulkan::ComputePipeline& pipeline = nested_pipeline(pipelines, state, step, table.first(pin_count));
    const StepDispatch dispatch(state, step, pipeline, pin_count * pipeline.local_size()[0], 1);
    graph.add_pass(
        state.step_name("nested sweeps", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            setup.read(state[Field::nested_sweeps], graph::Access::compute_read, "table");
            if (!step.reduced) update(setup, state[Field::nested_rows], "rows");
            update(setup, state[Field::tension_row], "tension_row");
            update(setup, state[Field::tension_column], "tension_column");
            if (is_sheared(step)) {
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
