#include "solver/explicit_pass.h"

#include <fmt/format.h>

#include "cloth/streams.h"
#include "shared/stream_types.h"
#include "shared/tile_types.h"

namespace drape {

namespace {

struct FlightDispatch {
    const vulkan::ComputePipeline* pipeline;
    std::uint32_t width, height;  ///< invocations
};

/// Strips where the state is stored through buffers, else tiles.
FlightDispatch flight_dispatch(Pipelines& pipelines, const ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::ExplicitPush>();
    const auto variant = [&](const char* shader) { return vulkan::variant_name(shader, {{"masked", state.masked()}}); };
    const vulkan::SpecializationConstant has_shear{"has_shear", push.relative_stiffness.z > 0 ? 1u : 0u};
    if (state.buffered)
        return {&pipelines.get(variant("explicit_stream.comp"),
                               {has_shear, {"steps", step.count}, {"advance", step.substep > 0 ? 1u : 0u}}),
                stream_invocations(push.grid.x, glsl::stream_width, static_cast<int>(step.count)),
                stream_bands(push.grid.y)};
    const Grid& grid = state.model->grid;
    const std::uint32_t halo = tile_halo_of(grid, glsl::tile_halo);
    return {&pipelines.get(variant("explicit_tile.comp"), {has_shear, {"steps", step.count}, {"halo", halo}}),
            tile_invocations(grid.columns(), halo), tile_invocations(grid.rows(), halo)};
}

/// Steps at once, or one that streams.
void add_flight(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const FlightDispatch dispatch = flight_dispatch(pipelines, state, step);
    graph.add_pass(
        state.step_name(step.count > 1 ? fmt::format("{} explicit steps", step.count) : "explicit step", step),
        [&](graph::PassSetup& setup) {
            write_spare(setup, state);
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
        },
        [dispatch, push = step.push<glsl::ExplicitPush>(), count = state.count](graph::PassContext& context) {
            context.dispatch(*dispatch.pipeline, push, dispatch.width, dispatch.height, count);
        });
    state.turn();
}

}  // namespace

void add_explicit_step(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const bool wind = state[Field::wind_force].valid();
    if (step.count > 1 || (step.streams && !wind)) return add_flight(graph, pipelines, state, step);
    const auto& push = step.push<glsl::ExplicitPush>();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0, has_shear = push.relative_stiffness.z > 0 ? 1 : 0,
                        has_bend = push.twist > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("explicit.comp",
                                           {{"masked", state.masked()}, {"wind", wind}, {"buffered", state.buffered}}),
                      {{"advance", advances}, {"has_shear", has_shear}, {"has_bend", has_bend}});
    graph.add_pass(
        state.step_name("explicit step", step),
        [&](graph::PassSetup& setup) {
            write_spare(setup, state);
            if (wind) setup.read(state[Field::wind_force], graph::Access::compute_read, "wind_force");
            if (state.masked())
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
        },
        [&pipeline, push, count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y), count);
        });
    state.turn();
}

}  // namespace drape
