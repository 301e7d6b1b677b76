#include "solver/statistics_pass.h"

namespace drape {

namespace {

/// Rows of invocations.
std::uint32_t strip_count(const Grid& grid) {
    constexpr auto rows = static_cast<std::uint32_t>(glsl::statistics_rows);
    return (grid.rows() + rows - 1) / rows;
}

/// Records of a cloth that the first pass leaves.
std::uint32_t partial_count(const Grid& grid) { return grid.columns() * strip_count(grid); }

graph::Handle add_partials(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                           const SimulationModel& model) {
    const bool collides = inputs.colliders.valid();
    std::vector<vulkan::SpecializationConstant> constants;
    if (collides) {
        constants = collider_constants(model.scene);
        constants.push_back({"leaves_out", model.options.skip ? 1u : 0u});
    }
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("statistics.comp", {{"masked", state.masked()}, {"colliding", collides}}), constants);
    graph::Handle records = graph.buffer<glsl::StatisticsRecord>(state.name + "/statistics of columns",
                                                                 partial_count(state.model->grid) * state.count,
                                                                 graph::Lifetime::transient);
    graph.add_pass(
        state.pass_name("statistics", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::position], graph::Access::compute_read, "position");
            setup.read(state[Field::displacement], graph::Access::compute_read, "displacement");
            setup.read(state[Field::end_excess], graph::Access::compute_read, "end_excess");
            setup.read(state[Field::statistics_reference], graph::Access::compute_read, "reference");
            records = setup.write(records, graph::Access::compute_write, "partials");
            setup.read(state[Field::tension_row], graph::Access::compute_read, "tension_row");
            setup.read(state[Field::tension_column], graph::Access::compute_read, "tension_column");
            if (state.masked()) {
                setup.read(state[Field::spring_share], graph::Access::compute_read, "spring_share_image");
                setup.read(state[Field::mass_share], graph::Access::compute_read, "mass_image");
            }
            if (collides) {
                setup.read(inputs.colliders, graph::Access::compute_read, "colliders");
                setup.read(inputs.colliders, graph::Access::compute_read, "collider_texels");
            }
        },
        [&pipeline, push = statistics_push(model, *state.model), height = strip_count(state.model->grid),
         count = state.count](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x), height, count);
        });
    return records;
}

std::uint32_t chunk_count(std::uint32_t partials) {
    constexpr auto chunk = static_cast<std::uint32_t>(glsl::statistics_chunk);
    return (partials + chunk - 1) / chunk;
}

/// A pass that joins `count` records of each cloth to one of each of their chunks.
graph::Handle add_sum(graph::Graph& graph, Pipelines& pipelines, const ClothState& state, const char* name,
                      graph::Handle records, std::uint32_t count, graph::Handle result) {
    const vulkan::ComputePipeline& pipeline = pipelines.get("statistics_sum.comp");
    const glsl::StatisticsSumPush push{static_cast<int>(count)};
    graph.add_pass(
        state.pass_name(name, "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(records, graph::Access::compute_read, "partials");
            result = setup.write(result, graph::Access::compute_write, "result");
        },
        [&pipeline, push, chunks = chunk_count(count), cloths = state.count](graph::PassContext& context) {
            constexpr auto width = static_cast<std::uint32_t>(glsl::workgroup_width);
            context.dispatch(pipeline, push, chunks * width, 1, cloths);
        });
    return result;
}

}  // namespace

std::string statistics_readback_name(const std::string& state) { return state + "/statistics on the host"; }

void add_statistics(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                    const SimulationModel& model) {
    graph::Handle records = add_partials(graph, pipelines, state, inputs, model);
    const std::uint32_t partials = partial_count(state.model->grid), chunks = chunk_count(partials);
    if (chunks > 1) {
        const graph::Handle joined = graph.buffer<glsl::StatisticsRecord>(
            state.name + "/statistics of chunks", chunks * state.count, graph::Lifetime::transient);
        records = add_sum(graph, pipelines, state, "statistics chunks", records, partials, joined);
    }
    const graph::Handle result = graph.buffer<glsl::StatisticsRecord>(statistics_readback_name(state.name), state.count,
                                                                      graph::Lifetime::host_output);
    add_sum(graph, pipelines, state, "statistics sum", records, chunks > 1 ? chunks : partials, result);
}

}  // namespace drape
