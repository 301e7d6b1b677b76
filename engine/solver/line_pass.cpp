#include "solver/line_pass.h"

#include <string>

#include "cloth/cyclic_lines.h"
#include "solver/step_dispatch.h"

namespace drape {

void add_line_control(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("line_control.comp");
    graph.add_pass(
        state.step_name("line control", step),
        [&](graph::PassSetup& setup) { update(setup, state[Field::line_control], "control"); },
        [&pipeline, push = step.push<glsl::LineControlPush>(), count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, 1, 1, count);
        });
}

void add_predict(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const bool wind = state[Field::wind_force].valid();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("predict.comp", {{"wind", wind}, {"buffered", state.buffered}}),
        {{"advance", advances}, {"turns", step.turns ? 1u : 0u}, {"strip_length", pipelines.strip_length()}});
    graph.add_pass(
        state.step_name("predict", step),
        [&](graph::PassSetup& setup) {
            update(setup, state[Field::position], "position");
            write_prediction(setup, state, step);
            update(setup, state[Field::position_remainder], "position_remainder");
            update(setup, state[Field::displacement_remainder], "displacement_remainder");
            if (wind) setup.read(state[Field::wind_force], graph::Access::compute_read, "wind_force");
            update(setup, state[Field::displacement_before], "displacement_before");
            update(setup, state[Field::velocity_excess], "velocity_excess");
            setup.read(state[Field::line_control], graph::Access::compute_read, "control");
        },
        [&pipeline, push = step.push<glsl::PredictPush>(), over = pipelines.over_strips(state.model->grid.size()),
         count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, over[0], over[1], count);
        });
    if (step.turns) state.turn_displacement();
}

namespace {

const vulkan::ComputePipeline& line_pipeline(Pipelines& pipelines, const ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::LinePush>();
    const vulkan::SpecializationConstant first{"first_iteration", step.iteration == 0 ? 1u : 0u};
    if (!step.reduced)
        return pipelines.get(
            vulkan::variant_name("line.comp",
                                 {{"masked", state.masked()}, {"bent", push.bend > 0}, {"buffered", state.buffered}}),
            {first});
    const auto [width, lines] = cyclic_group(push.particle_count);
    return pipelines.get(vulkan::variant_name("line_cyclic.comp", {{"masked", state.masked()}}),
                         {{vulkan::local_size_names[0], static_cast<std::uint32_t>(width)},
                          {vulkan::local_size_names[1], static_cast<std::uint32_t>(lines)},
                          first});
}

/// Invocations: one per line, or, reduced, one per particle.
glsl::ivec2 invocations(const Step& step) {
    const auto& push = step.push<glsl::LinePush>();
    return step.reduced ? glsl::ivec2{cyclic_group(push.particle_count).x, push.line_count}
                        : glsl::ivec2{push.line_count, 1};
}

}  // namespace

void add_line(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::LinePush>();
    const auto direction = static_cast<std::size_t>(push.channel);
    const StepDispatch dispatch(state, step, line_pipeline(pipelines, state, step), invocations(step));
    graph.add_pass(
        state.step_name("line " + std::string(spring_directions[direction].name), step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            if (!step.reduced) update(setup, state[Field::line_scratch], "scratch");
            update(setup, state[tension_of(direction)], "tension");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            update_in_place(setup, state[Field::line_control], "control");
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
