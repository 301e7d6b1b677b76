#include "solver/statistics_pass.h"

#include "solver/cloth_constants.h"
#include "solver/step_row.h"

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
    const std::string module = "statistics.comp";
    const std::vector<graph::PushConstants> each =
        pushes_of(state, model, [&](const ClothModel& cloth) { return statistics_push(model, cloth); });
    graph::Handle own = own_constants(graph, state, module, "statistics", each);
    const auto value = [&](std::string_view name) {
        if (name == "has_bend") return std::uint32_t{state.model->bend > 0};
        if (name == "has_skin") return std::uint32_t{state[Field::skin].valid()};
        if (name == "masked") return std::uint32_t{state.masked()};
        if (name == "rests_bent") return std::uint32_t{state.model->rests_bent()};
        return name == "own_rest" ? std::uint32_t{state.own_rest()} : scene_constant(model, name).value();
    };
    const vulkan::ComputePipeline& pipeline = pipelines.get(module, value, own.valid());
    graph::Handle records = graph.buffer<glsl::StatisticsRecord>(state.name + "/statistics of columns",
                                                                 partial_count(state.model->grid) * state.count(),
                                                                 graph::Lifetime::transient);
    add_compute_pass(graph, state.pass_name("statistics", "statistics"), pipeline, each.front(),
                     {state.model->grid.columns(), strip_count(state.model->grid), state.count()},
                     {&state, nullptr, inputs, {{"partials", &records}, {"constants", &own}}});
    return records;
}

std::uint32_t chunk_count(std::uint32_t partials) {
    constexpr auto chunk = static_cast<std::uint32_t>(glsl::statistics_chunk);
    return (partials + chunk - 1) / chunk;
}

/// A pass that joins `count` records of each cloth to one of each of their chunks.
graph::Handle add_sum(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const char* name,
                      graph::Handle records, std::uint32_t count, graph::Handle result) {
    constexpr auto width = static_cast<std::uint32_t>(glsl::workgroup_width);
    add_compute_pass(graph, state.pass_name(name, "statistics"), pipelines.get("statistics_sum.comp"),
                     glsl::StatisticsSumPush{static_cast<int>(count)}, {chunk_count(count) * width, 1, state.count()},
                     {.cloth = &state, .own = {{"partials", &records}, {"result", &result}}});
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
            state.name + "/statistics of chunks", chunks * state.count(), graph::Lifetime::transient);
        records = add_sum(graph, pipelines, state, "statistics chunks", records, partials, joined);
    }
    const graph::Handle result = graph.buffer<glsl::StatisticsRecord>(statistics_readback_name(state.name),
                                                                      state.count(), graph::Lifetime::host_output);
    add_sum(graph, pipelines, state, "statistics sum", records, chunks > 1 ? chunks : partials, result);
}

}  // namespace drape
