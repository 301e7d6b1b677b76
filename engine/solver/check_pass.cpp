#include "solver/check_pass.h"

#include "solver/step_dispatch.h"
#include "vulkan/api.h"

namespace drape {

namespace {

void add_residual(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("residual.comp", {{"masked", state.masked()}}));
    const glsl::ResidualPush push = state.model->residual;
    const StepDispatch dispatch(state, step, pipeline, state.model->grid.columns(),
                                residual_strip_count(state.model->grid));
    graph.add_pass(
        state.step_name("residual", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            setup.read(state[Field::displacement], graph::Access::compute_read, "displacement");
            setup.read(state[Field::tension_row], graph::Access::compute_read, "tension_row");
            setup.read(state[Field::tension_column], graph::Access::compute_read, "tension_column");
            state[Field::residuals] = setup.write(state[Field::residuals], graph::Access::compute_write, "partials");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace

void add_check(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SimulationModel& model,
               const Step& step) {
    add_residual(graph, pipelines, state, step);
    const vulkan::ComputePipeline& pipeline = pipelines.get("iteration_decision.comp");
    const SolverSettings& solver = model.scene.solver;
    const glsl::IterationPush push{static_cast<int>(residual_count(state.model->grid)), model.iteration_limit(),
                                   step.substep == 0 && step.iteration == 0 ? 1 : 0, static_cast<int>(solver.substeps)};
    const StepDispatch dispatch(state, step, pipeline, 1, 1);
    graph.add_pass(
        state.step_name("iteration decision", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::residuals], graph::Access::compute_read, "partials");
            setup.read(state[Field::iteration_sizes], graph::Access::compute_read, "sizes");
            dispatch.declare(setup);
            update_in_place(setup, state[Field::iterations], "state");
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

std::string iteration_readback_name(const ClothModel& cloth) { return cloth.name + "/iterations on the host"; }

void add_iteration_readback(graph::Graph& graph, const ClothState& state) {
    const graph::Handle empty =
        graph.buffer({iteration_readback_name(*state.model), sizeof(glsl::uvec4), graph::Lifetime::host_output});
    const auto target = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        state.pass_name("iteration readback", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::iterations], graph::Access::transfer_read);
            *target = setup.write(empty, graph::Access::transfer_write);
        },
        [iterations = state[Field::iterations], target](graph::PassContext& context) {
            const VkBufferCopy used{glsl::iteration_size_count * sizeof(glsl::uvec4), 0, sizeof(glsl::uvec4)};
            vkCmdCopyBuffer(context.commands(), context.buffer(iterations).handle(), context.buffer(*target).handle(),
                            1, &used);
        });
}

}  // namespace drape
