#include "solver/box_edge_pass.h"

#include <algorithm>

namespace drape {

namespace {

/// Of loops, that a particle may take: one to find whether it is near each box, and one for each box and each triangle
/// around it.
std::size_t rounds_each(const SimulationModel& model) {
    const auto boxes =
        static_cast<std::size_t>(std::ranges::count(model.scene.colliders, glsl::kind_box, &Collider::kind));
    constexpr std::size_t triangles = 6;  // around a particle
    return 2 + boxes * (2 + triangles);
}

}  // namespace

void add_box_edges(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                   const SimulationModel& model, const Step& step) {
    // The boxes are between the two ends.
    std::vector<vulkan::SpecializationConstant> ends = collider_constants(model.scene);
    std::erase_if(ends, [](const auto& each) { return each.name != "spheres_end" && each.name != "boxes_end"; });
    ends.push_back({"again", step.after_edges});
    const std::uint32_t strip = pipelines.strip_rows(rounds_each(model));
    ends.push_back({"strip_rows", strip});
    const Field from = step.after_edges ? Field::lifted_once : Field::displacement;
    const Field to = step.after_edges ? Field::lifted : Field::lifted_once;
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("box_edges.comp", {{"masked", state.masked()}, {"buffered", state.buffered}}), ends);
    glsl::CollisionPush push = state.model->box_edges();
    push.first = first_collider(model, *state.model, step.substep);
    graph.add_pass(
        state.step_name(step.after_edges ? "box edges again" : "box edges", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            setup.read(state[from], graph::Access::compute_read, "displacement");
            state[to] = setup.write(state[to], graph::Access::compute_write, "lifted");
            setup.read(inputs.colliders, graph::Access::compute_read, "colliders");
            if (state.masked()) setup.read(state[Field::cells], graph::Access::compute_read, "cells");
        },
        [&pipeline, push, strip, count = state.count](graph::PassContext& context) {
            const std::uint32_t strips = (static_cast<std::uint32_t>(push.grid.y) - 1) / strip + 1;
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x), strips, count);
        });
}

}  // namespace drape
