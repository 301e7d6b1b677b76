#include "solver/tear_pass.h"

#include "cloth/tear.h"
#include "solver/compute_pass.h"
#include "solver/cut_pass.h"

namespace drape {

std::string tear_count_name(const ClothModel& cloth) { return cloth.name + "/tear count"; }
std::string tear_loads_name(const ClothModel& cloth) { return cloth.name + "/tear loads"; }

void add_tear(graph::Graph& graph, Pipelines& pipelines, ClothState& state) {
    const ClothModel& model = *state.model;
    const Grid& grid = model.grid;
    graph::Handle loads = graph.image({tear_loads_name(model), VK_FORMAT_R32G32B32A32_SFLOAT, grid.columns(),
                                       grid.rows(), VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    graph::Handle count = add_cleared_count(graph, state.pass_name("tear count clear", "tear"), tear_count_name(model));
    const auto value = [&](std::string_view name) {
        return name == "masked" ? std::uint32_t{state.masked()} : state.own_rest();
    };
    const vulkan::ComputePipeline& pipeline = pipelines.get("tear.comp", value);
    add_compute_pass(graph, state.pass_name("tear", "tear"), pipeline, tear_push(model), {grid.columns(), grid.rows()},
                     {.cloth = &state, .own = {{"tear_loads", &loads}, {"count", &count}}});
}

std::vector<glsl::vec4> read_tear_loads(const graph::ResourcePool& pool, const ClothModel& cloth) {
    std::vector<glsl::vec4> loads(cloth.grid.particle_count());
    vulkan::download(pool.device(), pool.image(tear_loads_name(cloth)), std::as_writable_bytes(std::span(loads)));
    return loads;
}

}  // namespace drape
