#include "passes/sweep_pass.h"

#include "cloth/directions.h"
#include "cloth/streams.h"
#include "shared/stream_types.h"
#include "shared/tile_types.h"

namespace drape {

namespace {

std::uint32_t direction_bits(const glsl::SweepPush& push) {
    std::uint32_t directions = 0;
    for (int d = 0; d < static_cast<int>(spring_directions.size()); ++d)
        if (has_direction(push, d)) directions |= 1u << d;
    return directions;
}

struct SweepDispatch {
    const vulkan::ComputePipeline* pipeline;
    std::uint32_t width, height;  ///< invocations
};

/// Strips where the state is stored through buffers, else tiles.
SweepDispatch sweep_dispatch(PipelineCache& pipelines, const ClothState& state, const glsl::SweepPush& push,
                             bool tension) {
    const auto variant = [&](const char* shader) {
        return vulkan::variant_name(shader, {{"masked", state.masked()}, {"tension", tension}});
    };
    const vulkan::SpecializationConstant directions{"directions", direction_bits(push)};
    if (state.buffered)
        return {&pipelines.get(variant("sweep.comp"), {directions}),
                stream_invocations(push.grid.x, glsl::sweep_width, glsl::sweep_halo), 1};
    const Grid& grid = state.model->grid;
    const std::uint32_t halo = tile_halo_of(grid, glsl::sweep_tile_halo);
    return {&pipelines.get(variant("sweep_tile.comp"), {directions, {"halo", halo}}),
            tile_invocations(grid.columns(), halo), tile_invocations(grid.rows(), halo)};
}

/// What every sweep reads and writes.
void declare(graph::PassSetup& setup, ClothState& state) {
    setup.read(state[Field::position], graph::Access::compute_read, "position");
    setup.read(state[Field::displacement], graph::Access::compute_read, "displacement_in");
    graph::Handle& written = state[Field::displacement_spare];
    written = setup.write(written, graph::Access::compute_write, "displacement_out");
    if (state.masked()) setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
}

}  // namespace

void add_sweep(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::SweepPush>();
    const bool tension = step.last && state[Field::tension_row].valid() && push.compliance.x > 0;
    const SweepDispatch dispatch = sweep_dispatch(pipelines, state, push, tension);
    graph.add_pass(
        state.step_name("sweep of all springs", step),
        [&](graph::PassSetup& setup) {
            declare(setup, state);
            for (const auto& [field, variable] : {std::pair{Field::tension_row, "tension_row_out"},
                                                  std::pair{Field::tension_column, "tension_column_out"}})
                if (tension) state[field] = setup.write(state[field], graph::Access::compute_write, variable);
        },
        [dispatch, push, count = state.count](graph::PassContext& context) {
            context.dispatch(*dispatch.pipeline, push, dispatch.width, dispatch.height, count);
        });
    state.turn_displacement();
}

void add_twist_sweep(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::TwistSweepPush>();
    const bool second_order = state.model->plan.second_order;
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("twist_sweep.comp", {{"masked", state.masked()}, {"second_order", second_order}}));
    graph.add_pass(
        state.step_name("sweep of all twist", step),
        [&](graph::PassSetup& setup) {
            declare(setup, state);
            if (second_order) setup.read(state[Field::line_control], graph::Access::compute_read, "control");
        },
        [&pipeline, push, count = state.count](graph::PassContext& context) {
            const std::uint32_t width = stream_invocations(push.grid.x, glsl::twist_width, glsl::twist_halo);
            context.dispatch(pipeline, push, width, 1, count);
        });
    state.turn_displacement();
}

}  // namespace drape
