#include "passes/pin_pass.h"

namespace drape {

namespace {

glsl::PinPush pin_push(const ClothModel& model, const Step& step) {
    return {static_cast<int>(model.pinned.size()), static_cast<int>(step.substep * model.dynamic_pins.size())};
}

}  // namespace

void add_pin_release(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("pin_release.comp");
    graph.add_pass(
        state.step_name("pin release", step),
        [&](graph::PassSetup& setup) {
            update(setup, state[Field::position], "position");
            setup.read(state[Field::pinned_particles], graph::Access::compute_read, "pins");
            setup.read(state[Field::pin_motions], graph::Access::compute_read, "motions");
        },
        [&pipeline, push = pin_push(*state.model, step)](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.particle_count), 1);
        });
}

void add_pin_motion(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("pin_motion.comp");
    graph.add_pass(
        state.step_name("pin motion", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            state[Field::displacement] =
                setup.write(state[Field::displacement], graph::Access::compute_write, "displacement");
            setup.read(state[Field::pinned_particles], graph::Access::compute_read, "pins");
            setup.read(state[Field::pin_motions], graph::Access::compute_read, "motions");
        },
        [&pipeline, push = pin_push(*state.model, step)](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.particle_count), 1);
        });
}

}  // namespace drape
