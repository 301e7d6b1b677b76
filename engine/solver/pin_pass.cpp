#include "solver/pin_pass.h"

namespace drape {

namespace {

glsl::PinPush pin_push(const ClothState& state, const Step& step) {
    return {static_cast<int>(state.pinned_count), static_cast<int>(step.substep * state.pin_count)};
}

}  // namespace

void add_pin_release(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const MethodPlan& plan = state.model->plan;
    const bool tension = plan.release_stiffness.x > 0, masked = tension && state.masked();
    std::vector<vulkan::SpecializationConstant> constants;
    if (tension) constants.push_back({"advance", step.substep > 0 ? 1u : 0u});
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("pin_release.comp",
                             {{"masked", masked}, {"tension", tension}, {"second_order", plan.second_order}}),
        constants);
    const glsl::PinPush pins = pin_push(state, step);
    const glsl::ReleasePush push{plan.release_stiffness, state.model->grid.size(), pins.particle_count,
                                 pins.motion_first, state.model->reach()};
    graph.add_pass(
        state.step_name("pin release", step),
        [&](graph::PassSetup& setup) {
            update(setup, state[Field::position], "position");
            setup.read(state[Field::pinned_particles], graph::Access::compute_read, "pins");
            setup.read(state[Field::pin_motions], graph::Access::compute_read, "motions");
            if (plan.second_order) update_in_place(setup, state[Field::line_control], "control");
            update(setup, state[Field::displacement], "displacement");
            state[Field::displacement_remainder] = setup.write(state[Field::displacement_remainder],
                                                               graph::Access::compute_write, "displacement_remainder");
            if (masked) setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            if (!tension) return;
            setup.read(state[Field::tension_row], graph::Access::compute_read, "tension_row");
            setup.read(state[Field::tension_column], graph::Access::compute_read, "tension_column");
            setup.read(state[Field::tension_shear_down_right], graph::Access::compute_read, "tension_shear_down_right");
            setup.read(state[Field::tension_shear_down_left], graph::Access::compute_read, "tension_shear_down_left");
        },
        [&pipeline, push](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.particle_count), 1);
        });
}

void add_pin_motion(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
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
        [&pipeline, push = pin_push(state, step)](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.particle_count), 1);
        });
}

}  // namespace drape
