#include "passes/spring_pass.h"

#include <string>

#include "passes/declare.h"
#include "passes/step_dispatch.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration position = image_read(0, "position"),
                                        displacement_in = image_read(1, "displacement_in"),
                                        displacement_out = image_write(2, "displacement_out"),
                                        stiffness = image_read(3, "stiffness_image"),
                                        tension_in = image_read(4, "tension_in", VK_FORMAT_R32_SFLOAT),
                                        tension_out = image_write(5, "tension_out", VK_FORMAT_R32_SFLOAT);

constexpr vulkan::DescriptorDeclaration plain[] = {position, displacement_in, displacement_out};
constexpr vulkan::DescriptorDeclaration masked[] = {position, displacement_in, displacement_out, stiffness};
constexpr vulkan::DescriptorDeclaration stored[] = {position, displacement_in, displacement_out, tension_in,
                                                    tension_out};
constexpr vulkan::DescriptorDeclaration both[] = {position,  displacement_in, displacement_out,
                                                  stiffness, tension_in,      tension_out};

/// By [masked][stores tension].
const vulkan::ShaderInterface interfaces[2][2] = {
    {{"spring.comp", plain, &layouts::spring_push}, {"spring_tension.comp", stored, &layouts::spring_push}},
    {{"spring_masked.comp", masked, &layouts::spring_push},
     {"spring_masked_tension.comp", both, &layouts::spring_push}}};

}  // namespace

void add_spring(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const SpringWork& work = state.model->springs[step.work];
    const auto direction = static_cast<std::size_t>(work.pass.direction);
    const bool stores_tension = state.tension[direction].valid() &&
                                (state.model->carries_tension[direction] || (step.last && work.push.compliance > 0));
    const vulkan::ComputePipeline& pipeline = pipelines.get(interfaces[state.model->masked][stores_tension]);
    glsl::SpringPush push = work.push;
    push.first_iteration = step.iteration == 0 ? 1 : 0;
    const std::string name = std::string("spring ") + std::string(spring_directions[direction].name) +
                             (work.pass.parity == 0 ? " even" : " odd");
    const StepDispatch dispatch(state, step, pipeline, push.pair_count);
    graph.add_pass(
        state.step_name(name, step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            update(setup, state.displacement, 1, 2);
            if (state.model->masked) setup.read(state.stiffness, graph::Access::compute_read, 3);
            if (stores_tension) update(setup, state.tension[direction], 4, 5);
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
