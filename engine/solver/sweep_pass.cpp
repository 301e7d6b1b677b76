#include "solver/sweep_pass.h"

#include <string>
#include <utility>
#include <vector>

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

/// Of which springs a sweep handles the tension (shaders/include/sweep_tension.h).
enum class SweptTension { none, stretch, carried };

/// What the shaders call it, by direction, with _in and _out.
constexpr const char* tension_variables[] = {"tension_row", "tension_column", "tension_down_right",
                                             "tension_down_left"};

SweptTension swept_tension(const ClothState& state, const Step& step) {
    if (state.model->plan.carries_tension[0]) return SweptTension::carried;
    const bool wanted = step.last && state[Field::tension_row].valid() && step.push<glsl::SweepPush>().compliance.x > 0;
    return wanted ? SweptTension::stretch : SweptTension::none;
}

/// The first sweep of a substep is bound to where the state is, and reads none.
void declare_tension(graph::PassSetup& setup, ClothState& state, const Step& step, SweptTension tension) {
    const std::size_t count = tension == SweptTension::carried   ? std::size(tension_variables)
                              : tension == SweptTension::stretch ? stretch_direction_count
                                                                 : 0;
    for (std::size_t d = 0; d < count; ++d) {
        Field read = tension_of(d), written = tension_spare_of(d);
        if (!step.turns) std::swap(read, written);
        if (step.iteration == 0) read = tension_of(d);
        const std::string variable = tension_variables[d];
        if (tension == SweptTension::carried) setup.read(state[read], graph::Access::compute_read, variable + "_in");
        state[written] = setup.write(state[written], graph::Access::compute_write, variable + "_out");
    }
}

struct SweepDispatch {
    const vulkan::ComputePipeline* pipeline;
    std::uint32_t width, height;  ///< invocations
};

/// Strips where the state is stored through buffers, else tiles.
SweepDispatch sweep_dispatch(Pipelines& pipelines, const ClothState& state, const Step& step, SweptTension tension) {
    const auto& push = step.push<glsl::SweepPush>();
    const auto variant = [&](const char* shader) {
        return vulkan::variant_name(shader, {{"masked", state.masked()},
                                             {"tension", tension == SweptTension::stretch},
                                             {"carried", tension == SweptTension::carried}});
    };
    std::vector<vulkan::SpecializationConstant> constants{{"directions", direction_bits(push)}};
    if (tension == SweptTension::carried) constants.push_back({"first_iteration", step.iteration == 0 ? 1u : 0u});
    if (state.buffered)
        return {&pipelines.get(variant("sweep.comp"), constants),
                stream_invocations(push.grid.x, glsl::sweep_width, glsl::sweep_halo), stream_bands(push.grid.y)};
    const Grid& grid = state.model->grid;
    const std::uint32_t halo = tile_halo_of(grid, glsl::sweep_tile_halo);
    constants.push_back({"halo", halo});
    return {&pipelines.get(variant("sweep_tile.comp"), constants), tile_invocations(grid.columns(), halo),
            tile_invocations(grid.rows(), halo)};
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

void add_sweep(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::SweepPush>();
    const SweptTension tension = swept_tension(state, step);
    const SweepDispatch dispatch = sweep_dispatch(pipelines, state, step, tension);
    graph.add_pass(
        state.step_name("sweep of all springs", step),
        [&](graph::PassSetup& setup) {
            declare(setup, state);
            declare_tension(setup, state, step, tension);
        },
        [dispatch, push, count = state.count](graph::PassContext& context) {
            context.dispatch(*dispatch.pipeline, push, dispatch.width, dispatch.height, count);
        });
    state.turn_displacement();
}

void add_twist_sweep(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step) {
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
            context.dispatch(pipeline, push, width, stream_bands(push.grid.y), count);
        });
    state.turn_displacement();
}

}  // namespace drape
