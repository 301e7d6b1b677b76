#include "graph/dump.h"

#include <fmt/core.h>

#include <array>
#include <map>
#include <unordered_map>

namespace drape::graph {

Folding fold_passes(const Graph& graph, const Plan& plan) {
    std::unordered_map<std::string, std::uint32_t> signatures;
    std::vector<std::uint32_t> sequence;
    for (const PlannedPass& planned : plan.passes) {
        const Pass& pass = graph.passes()[planned.pass];
        std::string signature = pass.stage + '\n' + pass.label;
        for (const Use& use : pass.uses) {
            signature += fmt::format("\n{} {}", use.handle.resource, static_cast<int>(use.access));
        }
        const auto next = static_cast<std::uint32_t>(signatures.size());
        sequence.push_back(signatures.emplace(std::move(signature), next).first->second);
    }
    return fold(sequence);
}

std::vector<SkippedGroup> group_skipped(const Graph& graph, const Plan& plan) {
    std::unordered_map<std::string, const std::string*> labels;
    for (const Pass& pass : graph.passes()) labels.emplace(pass.name, &pass.label);
    std::vector<SkippedGroup> groups;
    std::map<std::pair<std::string, std::string>, std::size_t> places;
    for (const Remark& skipped : plan.skipped) {
        const auto label = labels.find(skipped.what);
        const std::string& what = label == labels.end() ? skipped.what : *label->second;
        const auto [place, added] = places.emplace(std::pair(what, skipped.reason), groups.size());
        if (added) groups.push_back({what, skipped.reason, 0});
        ++groups[place->second].count;
    }
    return groups;
}

std::size_t barrier_count(const Plan& plan) {
    std::size_t count = plan.final_barriers.size();
    for (const PlannedPass& pass : plan.passes) count += pass.barriers.size();
    return count;
}

std::string format_name(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return "rgba32f";
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return "rgba16f";
        case VK_FORMAT_R32G32_SFLOAT:
            return "rg32f";
        case VK_FORMAT_R32_SFLOAT:
            return "r32f";
        case VK_FORMAT_R32_UINT:
            return "r32ui";
        case VK_FORMAT_R8G8B8A8_UNORM:
            return "rgba8";
        case VK_FORMAT_R8G8B8A8_SRGB:
            return "rgba8 srgb";
        case VK_FORMAT_R8_UNORM:
            return "r8";
        case VK_FORMAT_R8_UINT:
            return "r8ui";
        case VK_FORMAT_D16_UNORM:
            return "d16";
        case VK_FORMAT_D32_SFLOAT:
            return "d32f";
        default:
            return fmt::format("VkFormat {}", static_cast<int>(format));
    }
}

std::string size_text(std::uint64_t bytes) {
    static constexpr std::array<const char*, 5> units = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto size = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; size >= 1024 && unit + 1 < units.size(); ++unit) size /= 1024;
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", size, units[unit]);
}

std::string dump(const Graph& graph, const Plan& plan, const std::string& format) {
    if (format == "text") return dump_text(graph, plan);
    if (format == "json") return dump_json(graph, plan);
    if (format == "dot") return dump_dot(graph, plan);
    throw GraphError(fmt::format("no dump format '{}': text, json or dot", format));
}

}  // namespace drape::graph
