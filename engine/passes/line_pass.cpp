#include "passes/line_pass.h"

#include <algorithm>
#include <string>

#include "passes/step_dispatch.h"

namespace drape {

namespace {

constexpr VkFormat integer = VK_FORMAT_R32_UINT;

}  // namespace

void declare_line(graph::Graph& graph, ClothState& state) {
    const ClothModel& model = *state.model;
    const auto image = [&](const std::string& part, VkFormat format, std::uint32_t width, std::uint32_t height) {
        return graph.image(
            {model.name + "/" + part, format, width, height, VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    };
    std::size_t springs = 0;
    for (const LineWork& line : model.lines)
        springs = std::max(springs, static_cast<std::size_t>(line.push.line_count) *
                                        static_cast<std::size_t>(line.push.particle_count - 1));
    // Persistent only because an invocation reads what it wrote itself: nothing in it outlives a pass.
    if (springs > 0)
        state.line_scratch =
            graph.buffer<glsl::vec2>(model.name + "/line scratch", springs, graph::Lifetime::persistent);
    if (!model.second_order) return;
    constexpr VkFormat vec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    state.displacement_before = image("displacement before", vec4, model.grid.columns(), model.grid.rows());
    state.velocity_excess = image("velocity excess", vec4, model.grid.columns(), model.grid.rows());
    state.line_control = image("line control", integer, glsl::control_texel_count, 1);
}

void add_line_control(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("line_control.comp");
    graph.add_pass(
        state.step_name("line control", step),
        [&](graph::PassSetup& setup) { update(setup, state.line_control, "control"); },
        [&pipeline](graph::PassContext& context) { context.dispatch(pipeline, 1, 1); });
}

void add_predict(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const bool wind = state.wind_force.valid();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("predict.comp", {{"wind", wind}}), {{"advance", advances}});
    graph.add_pass(
        state.step_name("predict", step),
        [&](graph::PassSetup& setup) {
            update(setup, state.position, "position");
            update(setup, state.displacement, "displacement");
            update(setup, state.position_rest, "position_remainder");
            update(setup, state.displacement_rest, "displacement_remainder");
            if (wind) setup.read(state.wind_force, graph::Access::compute_read, "wind_force");
            update(setup, state.displacement_before, "displacement_before");
            update(setup, state.velocity_excess, "velocity_excess");
            setup.read(state.line_control, graph::Access::compute_read, "control");
        },
        [&pipeline, push = state.model->predict](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

void add_line(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const ClothModel& model = *state.model;
    const LineWork& work = model.lines[step.work];
    const auto direction = static_cast<std::size_t>(work.direction);
    const bool stores_tension =
        state.tension[direction].valid() && (model.carries_tension[direction] || (step.last && work.compliant));
    const vulkan::ComputePipeline& pipeline = pipelines.get(vulkan::variant_name(
        "line.comp", {{"second_order", model.second_order}, {"masked", model.masked}, {"tension", stores_tension}}));
    glsl::LinePush push = work.push;
    push.first_iteration = step.iteration == 0 ? 1 : 0;
    const StepDispatch dispatch(state, step, pipeline, static_cast<std::uint32_t>(push.line_count), 1);
    graph.add_pass(
        state.step_name("line " + std::string(spring_directions[direction].name), step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, "position");
            update(setup, state.displacement, "displacement");
            update_in_place(setup, state.line_scratch, "scratch");
            if (model.masked) setup.read(state.stiffness, graph::Access::compute_read, "stiffness_image");
            if (stores_tension) update(setup, state.tension[direction], "tension");
            if (model.second_order) update_in_place(setup, state.line_control, "control");
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
