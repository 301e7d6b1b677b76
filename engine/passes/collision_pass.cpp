#include "passes/collision_pass.h"

#include <algorithm>

#include "passes/declare.h"
#include "passes/step_dispatch.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {image_read(0, "position"),
                                                         image_read(1, "displacement_in"),
                                                         image_write(2, "displacement_out"),
                                                         struct_buffer_read(3, "Planes", &layouts::collider),
                                                         struct_buffer_read(4, "Spheres", &layouts::collider),
                                                         struct_buffer_read(5, "Boxes", &layouts::collider),
                                                         struct_buffer_read(6, "Ellipsoids", &layouts::collider)};
const vulkan::ShaderInterface shader{"collision.comp", descriptors, &layouts::collision_push};

}  // namespace

void add_collision(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const SceneInputs& inputs,
                   const SimulationModel& model, const Step& step) {
    std::vector<vulkan::SpecializationConstant> constants;
    for (std::uint32_t kind = 0; kind < collider_kind_count; ++kind)
        constants.push_back({kind, inputs.colliders[kind].valid() ? 1u : 0u});
    constants.push_back({4, model.collision_rounds()});
    const vulkan::ComputePipeline& pipeline = pipelines.get(shader, constants);
    glsl::CollisionPush push = state.model->collision;
    push.first = first_colliders(model.scene, step.substep);
    const StepDispatch dispatch(state, step, pipeline, state.model->grid.size());
    graph.add_pass(
        state.step_name("collision", step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            update(setup, state.displacement, 1, 2);
            // A kind that the scene lacks borrows another kind's buffer: its count is 0, so nothing is read.
            const graph::Handle any = *std::ranges::find_if(inputs.colliders, &graph::Handle::valid);
            for (std::uint32_t kind = 0; kind < collider_kind_count; ++kind) {
                const graph::Handle buffer = inputs.colliders[kind];
                setup.read(buffer.valid() ? buffer : any, graph::Access::compute_read, 3 + kind);
            }
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
