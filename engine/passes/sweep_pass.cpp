#include "passes/sweep_pass.h"

#include "cloth/directions.h"
#include "cloth/streams.h"
#include "shared/stream_types.h"

namespace drape {

void add_sweep(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::SweepPush>();
    std::uint32_t directions = 0;
    for (int d = 0; d < static_cast<int>(spring_directions.size()); ++d)
        if (has_direction(push, d)) directions |= 1u << d;
    const bool tension = step.last && state[Field::tension_row].valid() && push.compliance.x > 0;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("sweep.comp", {{"masked", state.masked()}, {"tension", tension}}),
                      {{"directions", directions}});
    graph.add_pass(
        state.step_name("sweep of all springs", step),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            setup.read(state[Field::displacement], graph::Access::compute_read, "displacement_in");
            graph::Handle& written = state[Field::displacement_spare];
            written = setup.write(written, graph::Access::compute_write, "displacement_out");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
            for (const auto& [field, variable] : {std::pair{Field::tension_row, "tension_row_out"},
                                                  std::pair{Field::tension_column, "tension_column_out"}})
                if (tension) state[field] = setup.write(state[field], graph::Access::compute_write, variable);
        },
        [&pipeline, push, count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, stream_invocations(push.grid.x, glsl::sweep_width, glsl::sweep_halo), 1,
                             count);
        });
    state.turn_displacement();
}

}  // namespace drape
