#include "solver/bend_pass.h"

#include "fmt/format.h"

namespace drape {

namespace {

/// One invocation per element of `push`.
template <class Push>
void add_elements(graph::Graph& graph, const vulkan::ComputePipeline& pipeline, ClothState& state, const Step& step,
                  const std::string& name, const Push& push, bool second_order) {
    graph.add_pass(
        state.step_name(name, step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            if (second_order) setup.read(state[Field::line_control], graph::Access::compute_read, "control");
        },
        [&pipeline, push, count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.element_count.x),
                             static_cast<std::uint32_t>(push.element_count.y), count);
        });
}

}  // namespace

void add_bend(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::BendPush>();
    const std::string name =
        fmt::format("bend {} {}", bend_axes[static_cast<std::size_t>(push.channel)].name, push.colour);
    add_elements(
        graph,
        pipelines.get(vulkan::variant_name("bend.comp", {{"masked", state.masked()}, {"buffered", state.buffered}})),
        state, step, name, push, false);
}

void add_twist(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::TwistPush>();
    const std::string name = fmt::format("twist {} {}", push.first.x, push.first.y);
    const bool second_order = state.model->plan.second_order;
    const vulkan::ComputePipeline& pipeline = pipelines.get(vulkan::variant_name(
        "twist.comp", {{"masked", state.masked()}, {"second_order", second_order}, {"buffered", state.buffered}}));
    add_elements(graph, pipeline, state, step, name, push, second_order);
}

}  // namespace drape
