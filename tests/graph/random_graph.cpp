#include "random_graph.h"

#include <array>

namespace drape::graph {
namespace {

constexpr Lifetime lifetimes[] = {Lifetime::transient, Lifetime::persistent, Lifetime::constant, Lifetime::host_input,
                                  Lifetime::host_output};

bool readable(const Resource& resource) {
    if (resource.version > 0) return true;
    return resource.lifetime != Lifetime::transient && resource.lifetime != Lifetime::host_output;
}

}  // namespace

RandomGraphs::RandomGraphs(std::uint32_t seed) : random_(seed) {
    const std::uint32_t count = 2 + below(6);
    for (std::uint32_t i = 0; i < count; ++i) kinds_.push_back(below(15));
}

void RandomGraphs::declare(Graph& graph, std::uint32_t kind, std::uint32_t index) {
    const std::string name = "resource " + std::to_string(index);
    if (kind < 5) {
        handles_.push_back(graph.buffer({.name = name, .byte_count = 64, .lifetime = lifetimes[kind]}));
        return;
    }
    // The last two have a buffer view.
    constexpr std::array formats = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_D32_SFLOAT};
    handles_.push_back(graph.image({.name = name,
                                    .format = kind >= 13 ? formats[0] : formats[(kind - 5) % formats.size()],
                                    .width = 8,
                                    .height = 8,
                                    .lifetime = kind < 9 || kind == 13 ? Lifetime::persistent : Lifetime::transient,
                                    .buffer_view = kind >= 13}));
}

void RandomGraphs::use_something(Graph& graph, PassSetup& setup) {
    constexpr std::array reads = {Access::compute_read, Access::vertex_read,   Access::fragment_read,
                                  Access::index_read,   Access::indirect_read, Access::transfer_read};
    constexpr std::array writes = {Access::compute_write, Access::color_write, Access::depth_write,
                                   Access::resolve_write, Access::transfer_write};
    const std::uint32_t r = below(static_cast<std::uint32_t>(handles_.size()));
    const bool write = below(2) == 0;
    const Access access = write ? writes[below(5)] : reads[below(6)];
    if (!write && !readable(graph.resources()[r])) return;
    try {
        if (write) {
            handles_[r] = setup.write(handles_[r], access);
        } else {
            setup.read(handles_[r], access);
        }
    } catch (const GraphError&) {
        // Not every access fits every resource: the graph refuses it, and the pass does without.
    }
}

Graph RandomGraphs::make(std::uint32_t pass_count) {
    Graph graph;
    handles_.clear();
    for (std::uint32_t r = 0; r < kinds_.size(); ++r) declare(graph, kinds_[r], r);
    for (std::uint32_t p = 0; p < pass_count; ++p) {
        const std::string name = "pass " + std::to_string(p);
        graph.add_pass({name, "stage", name},
                       [&](PassSetup& setup) {
                           for (std::uint32_t use = 1 + below(6); use > 0; --use) use_something(graph, setup);
                       },
                       {});
    }
    return graph;
}

}  // namespace drape::graph
