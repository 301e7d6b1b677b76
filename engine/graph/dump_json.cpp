#include <json/json.h>

#include <array>
#include <string_view>
#include <utility>

#include "graph/dump.h"

namespace drape::graph {
namespace {

using FlagName = std::pair<VkFlags64, std::string_view>;

constexpr std::array stage_names = {
    FlagName{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, "all_commands"},
    FlagName{VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, "draw_indirect"},
    FlagName{VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, "index_input"},
    FlagName{VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, "vertex_shader"},
    FlagName{VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, "early_fragment_tests"},
    FlagName{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, "fragment_shader"},
    FlagName{VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, "late_fragment_tests"},
    FlagName{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, "color_attachment_output"},
    FlagName{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, "compute_shader"},
    FlagName{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, "all_transfer"},
    FlagName{VK_PIPELINE_STAGE_2_HOST_BIT, "host"},
};

constexpr std::array access_names = {
    FlagName{VK_ACCESS_2_MEMORY_READ_BIT, "memory_read"},
    FlagName{VK_ACCESS_2_MEMORY_WRITE_BIT, "memory_write"},
    FlagName{VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, "indirect_command_read"},
    FlagName{VK_ACCESS_2_INDEX_READ_BIT, "index_read"},
    FlagName{VK_ACCESS_2_SHADER_STORAGE_READ_BIT, "shader_storage_read"},
    FlagName{VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, "shader_storage_write"},
    FlagName{VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, "color_attachment_read"},
    FlagName{VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, "color_attachment_write"},
    FlagName{VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, "depth_stencil_attachment_read"},
    FlagName{VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, "depth_stencil_attachment_write"},
    FlagName{VK_ACCESS_2_TRANSFER_READ_BIT, "transfer_read"},
    FlagName{VK_ACCESS_2_TRANSFER_WRITE_BIT, "transfer_write"},
    FlagName{VK_ACCESS_2_HOST_READ_BIT, "host_read"},
};

template <std::size_t Size>
Json::Value names(VkFlags64 flags, const std::array<FlagName, Size>& table) {
    Json::Value list(Json::arrayValue);
    for (const auto& [flag, name] : table) {
        if (flags & flag) list.append(std::string(name));
    }
    return list;
}

std::string layout_name(VkImageLayout layout) {
    switch (layout) {
        case VK_IMAGE_LAYOUT_UNDEFINED:
            return "undefined";
        case VK_IMAGE_LAYOUT_GENERAL:
            return "general";
        case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
            return "color_attachment";
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
            return "depth_attachment";
        default:
            return std::to_string(static_cast<int>(layout));
    }
}

Json::Value barriers(const Graph& graph, const std::vector<Barrier>& list) {
    Json::Value values(Json::arrayValue);
    for (const Barrier& barrier : list) {
        Json::Value value;
        value["resource"] = graph.resources()[barrier.resource].name;
        value["reason"] = barrier.reason;
        value["source_stages"] = names(barrier.source_stages, stage_names);
        value["source_accesses"] = names(barrier.source_accesses, access_names);
        value["destination_stages"] = names(barrier.destination_stages, stage_names);
        value["destination_accesses"] = names(barrier.destination_accesses, access_names);
        if (barrier.old_layout != barrier.new_layout) {
            value["old_layout"] = layout_name(barrier.old_layout);
            value["new_layout"] = layout_name(barrier.new_layout);
        }
        values.append(value);
    }
    return values;
}

Json::Value pass_value(const Graph& graph, const PlannedPass& planned) {
    const Pass& pass = graph.passes()[planned.pass];
    Json::Value value;
    value["name"] = pass.name;
    value["label"] = pass.label;
    value["stage"] = pass.stage;
    value["uses"] = Json::Value(Json::arrayValue);
    for (const Use& use : pass.uses) {
        Json::Value entry;
        entry["resource"] = graph.resources()[use.handle.resource].name;
        entry["version"] = use.handle.version;
        if (use.handle.slice != UINT32_MAX) entry["slice"] = use.handle.slice;
        entry["access"] = std::string(access_name(use.access));
        if (!use.variable.empty()) entry["variable"] = use.variable;
        value["uses"].append(entry);
    }
    value["barriers"] = barriers(graph, planned.barriers);
    return value;
}

Json::Value resource_value(const Resource& resource, const Lifespan& lifespan) {
    Json::Value value;
    value["name"] = resource.name;
    value["kind"] = resource.is_image ? "image" : "buffer";
    value["lifetime"] = std::string(lifetime_name(resource.lifetime));
    value["bytes"] = Json::UInt64{resource.byte_count()};
    value["copies"] = copy_count(resource);
    value["exists"] = lifespan.used();
    if (lifespan.used()) {
        value["first_pass"] = lifespan.first;
        value["last_pass"] = lifespan.last;
    }
    if (resource.is_image) {
        value["format"] = format_name(resource.image.format);
        value["width"] = resource.image.width;
        value["height"] = resource.image.height;
        value["samples"] = static_cast<int>(resource.image.samples);
        if (resource.image.buffer_view) value["buffer_view"] = true;
        for (const std::string& slice : resource.image.slices) value["slices"].append(slice);
    }
    return value;
}

}  // namespace

std::string dump_json(const Graph& graph, const Plan& plan) {
    Json::Value root;
    root["declared_pass_count"] = Json::UInt64{graph.passes().size()};
    root["barrier_count"] = Json::UInt64{barrier_count(plan)};
    root["byte_count"] = Json::UInt64{plan.byte_count};
    root["passes"] = Json::Value(Json::arrayValue);
    for (const PlannedPass& planned : plan.passes) root["passes"].append(pass_value(graph, planned));
    root["final_barriers"] = barriers(graph, plan.final_barriers);
    root["resources"] = Json::Value(Json::arrayValue);
    for (std::size_t r = 0; r < graph.resources().size(); ++r) {
        root["resources"].append(resource_value(graph.resources()[r], plan.lifespans[r]));
    }
    const auto add_remark = [&root](const char* list, const auto& remark) {
        Json::Value value;
        value["what"] = remark.what;
        value["reason"] = remark.reason;
        root[list].append(value);
    };
    root["skipped"] = root["compromises"] = root["choices"] = Json::Value(Json::arrayValue);
    for (const Remark& skipped : plan.skipped) add_remark("skipped", skipped);
    for (const Remark& compromise : graph.compromises()) add_remark("compromises", compromise);
    for (const Remark& choice : graph.choices()) add_remark("choices", choice);
    Json::StreamWriterBuilder writer;
    writer["indentation"] = "  ";
    return Json::writeString(writer, root) + "\n";
}

}  // namespace drape::graph
