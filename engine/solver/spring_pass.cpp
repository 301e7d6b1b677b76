#include "solver/spring_pass.h"

#include <string>

#include "solver/step_dispatch.h"

namespace drape {

void add_spring(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    glsl::SpringPush push = step.push<glsl::SpringPush>();
    push.first_iteration = step.iteration == 0 ? 1 : 0;
    const auto direction = static_cast<std::size_t>(push.channel);
    const bool stores_tension = state[tension_of(direction)].valid() &&
                                (state.model->plan.carries_tension[direction] || (step.last && push.compliance > 0));
    const vulkan::ComputePipeline& pipeline = pipelines.get(vulkan::variant_name(
        "spring.comp", {{"masked", state.masked()}, {"tension", stores_tension}, {"buffered", state.buffered}}));
    const std::string name =
        std::string("spring ") + std::string(spring_directions[direction].name) + (push.parity == 0 ? " even" : " odd");
    const StepDispatch dispatch(state, step, pipeline, push.pair_count);
    graph.add_pass(
        state.step_name(name, step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            if (stores_tension) update(setup, state[tension_of(direction)], "tension");
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
