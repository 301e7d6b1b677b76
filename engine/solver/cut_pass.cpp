#include "solver/cut_pass.h"

#include <memory>

#include "solver/compute_pass.h"
#include "vulkan/api.h"

namespace drape {

using graph::Access;

std::string cut_count_name(const ClothModel& cloth) { return cloth.name + "/cut count"; }
std::string cut_flags_name(const ClothModel& cloth) { return cloth.name + "/cut flags"; }
std::string cut_fractions_name(const ClothModel& cloth) { return cloth.name + "/cut fractions"; }

graph::Handle declare_cutters(graph::Graph& graph, std::size_t cutter_count) {
    return graph.buffer<glsl::CutterTriangle>(cutters_name, cutter_count * glsl::cutter_triangle_count,
                                              graph::Lifetime::host_input);
}

graph::Handle add_cleared_count(graph::Graph& graph, const graph::PassName& pass, const std::string& name) {
    graph::Handle count = graph.buffer<glsl::uint>(name, 1, graph::Lifetime::host_output);
    const auto cleared = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        pass, [&](graph::PassSetup& setup) { *cleared = count = setup.write(count, Access::transfer_write); },
        [cleared](graph::PassContext& context) {
            vkCmdFillBuffer(context.commands(), context.buffer(*cleared).handle(), 0, VK_WHOLE_SIZE, 0);
        });
    return count;
}

void add_cut(graph::Graph& graph, Pipelines& pipelines, ClothState& state, graph::Handle cutters,
             std::size_t cutter_count) {
    const ClothModel& model = *state.model;
    const Grid& grid = model.grid;
    graph::Handle flags = graph.image({cut_flags_name(model), VK_FORMAT_R32_UINT, 2 * (grid.columns() - 1),
                                       grid.rows() - 1, VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    graph::Handle fractions = graph.image({cut_fractions_name(model), VK_FORMAT_R32G32B32A32_SFLOAT, grid.columns(),
                                           grid.rows(), VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    graph::Handle count = add_cleared_count(graph, state.pass_name("cut count clear", "cut"), cut_count_name(model));
    const vulkan::ComputePipeline& pipeline =
        pipelines.get("cut.comp", [&](std::string_view) { return state.masked() ? 1u : 0u; });
    const int triangles = static_cast<int>(cutter_count) * glsl::cutter_triangle_count;
    add_compute_pass(
        graph, state.pass_name("cut", "cut"), pipeline, glsl::CutPush{grid.size(), triangles, 0},
        {grid.columns(), grid.rows()},
        {.cloth = &state,
         .own = {{"cut_flags", &flags}, {"cut_fractions", &fractions}, {"cutters", &cutters}, {"count", &count}}});
}

CutFindings read_findings(const graph::ResourcePool& pool, const ClothModel& cloth) {
    CutFindings findings{std::vector<std::uint32_t>(cloth.grid.cells().size() * 2),
                         std::vector<glsl::vec4>(cloth.grid.particle_count())};
    vulkan::download(pool.device(), pool.image(cut_flags_name(cloth)),
                     std::as_writable_bytes(std::span(findings.triangle_flags)));
    vulkan::download(pool.device(), pool.image(cut_fractions_name(cloth)),
                     std::as_writable_bytes(std::span(findings.fractions)));
    return findings;
}

}  // namespace drape
