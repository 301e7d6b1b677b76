#include "solver/cloth_constants.h"

#include <fmt/format.h>

#include <algorithm>

namespace drape {

std::vector<graph::PushConstants> pushes_of(const ClothState& state, const SimulationModel& model,
                                            const std::function<graph::PushConstants(const ClothModel&)>& push) {
    std::vector<graph::PushConstants> each;
    for (const std::size_t cloth : state.cloths) each.push_back(push(model.cloths[cloth]));
    return each;
}

graph::Handle own_constants(graph::Graph& graph, ClothState& state, const std::string& module, const std::string& pass,
                            const std::vector<graph::PushConstants>& each) {
    if (each.size() < 2 || !vulkan::module_interface(module).constants.contains("has_constants")) return {};
    const auto is_first = [&](const graph::PushConstants& one) { return one.bytes == each.front().bytes; };
    // Cloths that are unlike may have the same here at some number of substeps, and others at another.
    if (!state.unlike && std::ranges::all_of(each, is_first)) return {};
    std::vector<std::byte> bytes;
    for (const graph::PushConstants& one : each) bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.end());
    const std::string stem = state.name + "/constants of " + pass;
    std::string name = stem;
    for (int number = 2; state.constants->try_emplace(name, bytes).first->second != bytes; ++number)
        name = fmt::format("{} {}", stem, number);
    graph::Handle& handle = state.constant_buffers[name];
    if (!handle.valid()) handle = graph.buffer({name, bytes.size(), graph::Lifetime::host_input, each.front().layout});
    return handle;
}

}  // namespace drape
