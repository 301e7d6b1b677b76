#include "passes/bend_pass.h"

#include "fmt/format.h"
#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {
    image_read(0, "position"), image_read(1, "displacement_in"), image_write(2, "displacement_out"),
    image_read(3, "stiffness_image"),  // the masked variant only
};
/// By [masked].
const vulkan::ShaderInterface bend[2] = {{"bend.comp", std::span(descriptors).first(3), &layouts::bend_push},
                                         {"bend_masked.comp", descriptors, &layouts::bend_push}};
const vulkan::ShaderInterface twist[2] = {{"twist.comp", std::span(descriptors).first(3), &layouts::twist_push},
                                          {"twist_masked.comp", descriptors, &layouts::twist_push}};

/// One invocation per element of `push`.
template <class Push>
void add_elements(graph::Graph& graph, const vulkan::ComputePipeline& pipeline, ClothState& state, const Step& step,
                  const std::string& name, const Push& push) {
    graph.add_pass(
        state.step_name(name, step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            update(setup, state.displacement, 1, 2);
            if (state.model->masked) setup.read(state.stiffness, graph::Access::compute_read, 3);
        },
        [&pipeline, push](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.element_count.x),
                             static_cast<std::uint32_t>(push.element_count.y));
        });
}

}  // namespace

void add_bend(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const BendWork& work = state.model->bends[step.work];
    const std::string name =
        fmt::format("bend {} {}", bend_axes[static_cast<std::size_t>(work.pass.axis)].name, work.pass.colour);
    add_elements(graph, pipelines.get(bend[state.model->masked]), state, step, name, work.push);
}

void add_twist(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const TwistWork& work = state.model->twists[step.work];
    const std::string name = fmt::format("twist {} {}", work.pass.first.x, work.pass.first.y);
    add_elements(graph, pipelines.get(twist[state.model->masked]), state, step, name, work.push);
}

}  // namespace drape
