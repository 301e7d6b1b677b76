#include "passes/pin_pass.h"

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration release_descriptors[] = {
    image_read(0, "position_in"), image_write(1, "position_out"),
    struct_buffer_read(2, "Pins", &layouts::pinned_particle), struct_buffer_read(3, "Motions", &layouts::pin_motion)};
const vulkan::ShaderInterface release_shader{"pin_release.comp", release_descriptors, &layouts::pin_push};

constexpr vulkan::DescriptorDeclaration motion_descriptors[] = {
    image_read(0, "position"), image_write(1, "displacement"), struct_buffer_read(2, "Pins", &layouts::pinned_particle),
    struct_buffer_read(3, "Motions", &layouts::pin_motion)};
const vulkan::ShaderInterface motion_shader{"pin_motion.comp", motion_descriptors, &layouts::pin_push};

glsl::PinPush pin_push(const ClothModel& model, const Step& step) {
    return {static_cast<int>(model.pinned.size()), static_cast<int>(step.substep * model.dynamic_pins.size())};
}

}  // namespace

void add_pin_release(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(release_shader);
    graph.add_pass(
        state.step_name("pin release", step),
        [&](graph::PassSetup& setup) {
            update(setup, state.position, 0, 1);
            setup.read(state.pinned, graph::Access::compute_read, 2);
            setup.read(state.pin_motions, graph::Access::compute_read, 3);
        },
        [&pipeline, push = pin_push(*state.model, step)](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.particle_count), 1);
        });
}

void add_pin_motion(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(motion_shader);
    graph.add_pass(
        state.step_name("pin motion", step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            state.displacement = setup.write(state.displacement, graph::Access::compute_write, 1);
            setup.read(state.pinned, graph::Access::compute_read, 2);
            setup.read(state.pin_motions, graph::Access::compute_read, 3);
        },
        [&pipeline, push = pin_push(*state.model, step)](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.particle_count), 1);
        });
}

}  // namespace drape
