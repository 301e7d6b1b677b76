#include "solver/form_pass.h"

#include <fmt/format.h>

#include <cstring>

#include "solver/compute_pass.h"

namespace drape {

namespace {

constexpr const char *nodes_name = "form nodes", *corners_name = "form corners", *guesses_name = "form guesses",
                     *sides_name = "form sides", *distances_name = "form distances";

template <class T>
void write(const graph::ResourcePool& pool, std::uint32_t slot, const char* name, const std::vector<T>& values) {
    if (!pool.has(name)) return;
    const auto bytes = std::as_bytes(std::span(values));
    std::memcpy(pool.buffer(name, slot).mapped().data(), bytes.data(), bytes.size());
}

}  // namespace

void declare_forms(graph::Graph& graph, const SimulationModel& model, SceneInputs& inputs) {
    const std::vector<glsl::FormPush> pushes = model.mesh_fields.form_pushes(model.scene.solver.substeps);
    if (pushes.empty()) return;
    // The last mesh's lists end them all.
    const glsl::ivec4 &first = pushes.back().first, &count = pushes.back().count;
    const auto entries = [](int begin, int each) {
        return static_cast<std::size_t>(begin) + 2 * static_cast<std::size_t>(each);
    };
    using graph::Lifetime;
    inputs.form_nodes = graph.buffer<glsl::FormNode>(nodes_name, entries(first.x, count.x), Lifetime::host_input);
    inputs.form_corners = graph.buffer<glsl::vec4>(corners_name, entries(first.y, 3 * count.y), Lifetime::host_input);
    inputs.form_guesses = graph.buffer<glsl::uint>(guesses_name, entries(first.z, count.z), Lifetime::host_input);
    inputs.form_sides = graph.buffer<glsl::uint>(sides_name, entries(first.w, count.w), Lifetime::host_input);
}

void add_forms(graph::Graph& graph, Pipelines& pipelines, const SimulationModel& model, SceneInputs& inputs) {
    const std::vector<glsl::FormPush> pushes = model.mesh_fields.form_pushes(model.scene.solver.substeps);
    std::size_t samples = 0;
    const auto size = [](const glsl::FormPush& push) {
        const auto count = [](int axis) { return static_cast<std::uint32_t>(axis); };
        return DispatchSize{count(push.size.x), count(push.size.y), count(push.size.z)};
    };
    for (const glsl::FormPush& push : pushes)
        samples += std::size_t{size(push).width} * size(push).height * size(push).depth;
    if (samples == 0) return;
    graph::Handle distances = graph.buffer<glsl::vec2>(distances_name, samples, graph::Lifetime::transient);
    for (std::size_t k = 0; k < pushes.size(); ++k)
        for (const auto& [module, label] : {std::pair{"mesh_form.comp", "distances to a mesh that deforms"},
                                            {"mesh_form_pack.comp", "field of a mesh that deforms"}}) {
            PassResources resources{.inputs = inputs, .own = {{"form_distances", &distances}}};
            resources.own.emplace_back("mesh_fields", &inputs.mesh_fields);
            add_compute_pass(graph, {fmt::format("{} ({})", label, k), "simulate", label}, pipelines.get(module),
                             pushes[k], size(pushes[k]), std::move(resources));
        }
}

void write_forms(const graph::ResourcePool& pool, std::uint32_t slot, const FormLists& lists) {
    write(pool, slot, nodes_name, lists.nodes);
    write(pool, slot, corners_name, lists.corners);
    write(pool, slot, guesses_name, lists.guesses);
    write(pool, slot, sides_name, lists.sides);
}

}  // namespace drape
