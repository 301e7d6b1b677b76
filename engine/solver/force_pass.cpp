#include "solver/force_pass.h"

namespace drape {

void add_force(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const bool wind = state[Field::wind_force].valid();
    const bool before = step.last && state[Field::displacement_before].valid();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("force.comp", {{"wind", wind}, {"before", before}, {"buffered", state.buffered}}),
        {{"advance", advances}, {"strip_length", pipelines.strip_length()}});
    graph.add_pass(
        state.step_name("force", step),
        [&](graph::PassSetup& setup) {
            update(setup, state[Field::position], "position");
            write_prediction(setup, state, step);
            update(setup, state[Field::position_remainder], "position_remainder");
            update(setup, state[Field::displacement_remainder], "displacement_remainder");
            if (wind) setup.read(state[Field::wind_force], graph::Access::compute_read, "wind_force");
            if (before)
                state[Field::displacement_before] =
                    setup.write(state[Field::displacement_before], graph::Access::compute_write, "displacement_before");
        },
        [&pipeline, push = step.push<glsl::ForcePush>(), over = pipelines.over_strips(state.model->grid.size()),
         count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, over[0], over[1], count);
        });
    if (step.turns) state.turn_displacement();
}

void add_advance(graph::Graph& graph, Pipelines& pipelines, ClothState& state) {
    const bool excess = state[Field::end_excess].valid();
    std::vector<vulkan::SpecializationConstant> constants = {{"strip_length", pipelines.strip_length()}};
    if (excess) constants.push_back({"collides", state.model->collides ? 1u : 0u});
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("advance.comp", {{"home", state.away}, {"excess", excess}, {"buffered", state.buffered}}),
        constants);
    // Where micro-steps go to and fro, the substep before the last is in the other image.
    const graph::Handle before =
        state.model->plan.spare_state ? state[Field::displacement_spare] : state[Field::displacement_before];
    graph.add_pass(
        state.pass_name("advance", "simulate"),
        [&](graph::PassSetup& setup) {
            // Before the spare images are written: it may be one of them.
            if (excess) setup.read(before, graph::Access::compute_read, "displacement_before");
            if (state.away) {
                write_spare(setup, state);
            } else {
                update(setup, state[Field::position], "position");
                setup.read(state[Field::displacement], graph::Access::compute_read, "displacement_in");
                update(setup, state[Field::position_remainder], "position_remainder");
            }
            if (excess)
                state[Field::end_excess] =
                    setup.write(state[Field::end_excess], graph::Access::compute_write, "end_excess_out");
        },
        [&pipeline, push = glsl::GridPush{state.model->grid.size()},
         over = pipelines.over_strips(state.model->grid.size()), count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, over[0], over[1], count);
        });
    if (state.away) state.turn();
}

}  // namespace drape
