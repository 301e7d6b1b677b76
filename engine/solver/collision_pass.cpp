#include "solver/collision_pass.h"

#include <algorithm>

#include "solver/step_dispatch.h"

namespace drape {

namespace {

/// Of loops, that a particle may take. Per round over all colliders: two of each that is not among the early ones, and
/// two times Newton's 24 of each ellipsoid.
std::size_t rounds_each(const SimulationModel& model) {
    const std::vector<Collider>& colliders = model.scene.colliders;
    const auto ellipsoids =
        static_cast<std::size_t>(std::ranges::count(colliders, glsl::kind_ellipsoid, &Collider::kind));
    return model.collision_rounds() * (1 + 2 * colliders.size() + 48 * ellipsoids) + colliders.size();
}

}  // namespace

void add_collision(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                   const SimulationModel& model, const Step& step) {
    std::vector<vulkan::SpecializationConstant> constants = collider_constants(model.scene);
    constants.push_back({"round_count", model.collision_rounds()});
    const std::uint32_t strip = pipelines.strip_rows(rounds_each(model));
    constants.push_back({"strip_rows", strip});
    constants.push_back({"leaves_out", model.options.skip ? 1u : 0u});
    const bool history = state.model->plan.second_order;
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("collision.comp",
                             {{"history", history}, {"led", step.after_edges}, {"buffered", state.buffered}}),
        constants);
    glsl::CollisionPush push = state.model->collision;
    push.first = first_collider(model, *state.model, step.substep);
    const StepDispatch dispatch(state, step, pipeline, static_cast<std::uint32_t>(push.grid.x),
                                (static_cast<std::uint32_t>(push.grid.y) - 1) / strip + 1);
    graph.add_pass(
        state.step_name("collision", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            update(setup, state[Field::displacement], "displacement");
            if (history) {
                update_in_place(setup, state[Field::displacement_before], "displacement_before");
                update_in_place(setup, state[Field::line_control], "control");
            }
            if (step.after_edges) setup.read(state[Field::lifted], graph::Access::compute_read, "lifted");
            setup.read(inputs.colliders, graph::Access::compute_read, "colliders");
            setup.read(inputs.colliders, graph::Access::compute_read, "collider_texels");
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
