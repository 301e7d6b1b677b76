#include "solver/statistics_pass.h"

#include <cstring>

#include "cloth/forces.h"
#include "solver/cloth_constants.h"
#include "solver/readback_pass.h"
#include "solver/step_row.h"

namespace drape {

namespace {

/// Rows of invocations.
std::uint32_t strip_count(const Grid& grid) {
    constexpr auto rows = static_cast<std::uint32_t>(glsl::statistics_rows);
    return (grid.rows() + rows - 1) / rows;
}

std::string impulse_readback_name(const std::string& state) { return state + "/impulses on the host"; }

/// Returns each cloth's sums of the frame's impulses; empty ones where the scene does not want forces.
std::vector<std::span<const std::byte>> impulse_sums(const ClothLayout& layout, const graph::ResourcePool& pool,
                                                     std::uint32_t slot) {
    if (layout.model.scene.forces) return layout.parts(pool, slot, impulse_readback_name);
    return std::vector<std::span<const std::byte>>(layout.model.cloths.size());
}

std::string seam_readback_name(const std::string& state) { return state + "/seam loads on the host"; }

/// Returns what each cloth's seams bore in the frame; nothing where none of them rips.
std::vector<std::span<const std::byte>> seam_loads(const ClothLayout& layout, const graph::ResourcePool& pool,
                                                   std::uint32_t slot) {
    std::vector<std::span<const std::byte>> all;
    for (const ClothModel& cloth : layout.model.cloths)
        all.push_back(rips(cloth.sewn) ? pool.buffer(seam_readback_name(cloth.name), slot).mapped()
                                       : std::span<const std::byte>());
    return all;
}

std::string gas_readback_name(const std::string& state) { return state + "/gas on the host"; }

/// Returns the state of the gas that each cloth closes in; nothing where it closes none in.
std::vector<std::span<const std::byte>> gas_states(const ClothLayout& layout, const graph::ResourcePool& pool,
                                                   std::uint32_t slot) {
    std::vector<std::span<const std::byte>> all;
    for (const ClothModel& cloth : layout.model.cloths)
        all.push_back(cloth.gas ? pool.buffer(gas_readback_name(cloth.name), slot).mapped()
                                : std::span<const std::byte>());
    return all;
}

std::string iteration_readback_name(const std::string& state) { return state + "/iterations on the host"; }

/// Adds the tension that steps of a method do not keep.
void add_tension(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SimulationModel& model) {
    const Grid& grid = state.model->grid;
    const std::vector<graph::PushConstants> each =
        pushes_of(state, model, [](const ClothModel& cloth) { return *cloth.scheme.gathered_tension; });
    const std::string module = "tension.comp";
    graph::Handle own = own_constants(graph, state, module, "tension", each);
    const auto value = [&](std::string_view) { return state.own_rest(); };
    add_compute_pass(graph, state.pass_name("tension", "statistics"), pipelines.get(module, value, own.valid()),
                     each.front(), {grid.columns(), grid.rows(), state.count()},
                     {&state, nullptr, {}, {{"constants", &own}}});
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
        if (name == "turned") return std::uint32_t{state[Field::angular_error].valid()};
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
    if (state.model->scheme.gathered_tension) add_tension(graph, pipelines, state, model);
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
    if (model.scene.forces)
        add_image_readback(graph, state.pass_name("impulse readback", "statistics"), state[Field::impulses],
                           impulse_readback_name(state.name));
    if (rips(state.model->sewn))
        add_image_readback(graph, state.pass_name("seam readback", "statistics"), state[Field::seam_loads],
                           seam_readback_name(state.name));
    if (state.model->gas)
        add_image_readback(graph, state.pass_name("gas readback", "statistics"), state[Field::gas],
                           gas_readback_name(state.name));
    if (model.adaptive())
        add_buffer_readback(graph, state.pass_name("iteration readback", "statistics"), state[Field::iterations],
                            glsl::iteration_size_count * sizeof(glsl::uvec4), sizeof(glsl::uvec4),
                            iteration_readback_name(state.name));
}

std::vector<StatisticsBytes> statistics_bytes(const ClothLayout& layout, const graph::ResourcePool& pool,
                                              std::uint32_t slot) {
    const std::vector<std::span<const std::byte>> records = layout.parts(pool, slot, statistics_readback_name),
                                                  impulses = impulse_sums(layout, pool, slot),
                                                  seams = seam_loads(layout, pool, slot),
                                                  gases = gas_states(layout, pool, slot);
    std::vector<StatisticsBytes> all;
    for (std::size_t cloth = 0; cloth < records.size(); ++cloth)
        all.push_back({records[cloth], impulses[cloth], seams[cloth], gases[cloth]});
    return all;
}

std::vector<ClothStatistics> statistics_from(std::span<const StatisticsBytes> bytes, std::uint32_t frame,
                                             const SimulationModel& run) {
    std::vector<ClothStatistics> all;
    for (const ClothModel& cloth : run.cloths) {
        const StatisticsBytes& own = bytes[all.size()];
        glsl::StatisticsRecord record;
        std::memcpy(&record, own.record.data(), sizeof record);
        all.push_back(cloth_statistics(run, cloth, record, frame, own.impulses));
        if (frame > 0 && !own.seams.empty()) all.back().seams = seam_statistics(cloth, own.seams);
        if (!own.gas.empty()) all.back().gas = gas_statistics(own.gas);
    }
    std::vector<std::span<const std::byte>> impulses;
    for (const StatisticsBytes& own : bytes) impulses.push_back(own.impulses);
    settle_seams(run, impulses, frame, all);
    return all;
}

std::vector<ClothStatistics> read_statistics(const ClothLayout& layout, const graph::ResourcePool& pool,
                                             std::uint32_t slot, std::uint32_t frame, const SimulationModel& run) {
    std::vector<ClothStatistics> all = statistics_from(statistics_bytes(layout, pool, slot), frame, run);
    if (!run.adaptive()) return all;
    for (std::size_t cloth = 0; cloth < all.size(); ++cloth) {
        glsl::uvec4 used;
        const std::string name = iteration_readback_name(run.cloths[cloth].name);
        std::memcpy(&used, pool.buffer(name, slot).mapped().data(), sizeof used);
        all[cloth].iteration_count = used.x;
    }
    return all;
}

}  // namespace drape
