#include <fmt/core.h>
#include <volk.h>

#include <algorithm>

#include "graph/executor.h"
#include "vulkan/structure.h"

namespace drape::graph {
namespace {

using vulkan::DescriptorAccess;
using vulkan::DescriptorKind;

std::string_view descriptor_access_name(DescriptorAccess access) {
    if (access == DescriptorAccess::read) return "reads";
    return access == DescriptorAccess::write ? "writes" : "reads and writes";
}

}  // namespace

const Use& PassContext::use_of(Handle handle) const {
    for (const Use& use : pass_.uses) {
        if (use.handle == handle) return use;
    }
    if (handle.resource >= graph_.resources().size()) {
        throw GraphError(
            fmt::format("pass '{}': a handle that names no resource of its graph (was it set before the "
                        "pass's set-up ran?)",
                        pass_.name));
    }
    throw GraphError(fmt::format("pass '{}', resource '{}': access to version {}, which the pass did not declare",
                                 pass_.name, graph_.resources()[handle.resource].name, handle.version));
}

const vulkan::Image& PassContext::image(Handle handle) const {
    return pool_.image(graph_.resources()[use_of(handle).handle.resource].name);
}

const vulkan::Buffer& PassContext::buffer(Handle handle) const {
    return pool_.buffer(graph_.resources()[use_of(handle).handle.resource].name, slot_);
}

VkImageLayout PassContext::layout(Handle handle) const { return access_scope(use_of(handle).access).layout; }

/// The declared use a descriptor is bound to: the writing one, or any reading one of the binding.
const Use& PassContext::use_at(const vulkan::Pipeline& pipeline,
                               const vulkan::DescriptorDeclaration& descriptor) const {
    const auto at = [&](const Use& use) { return use.binding == descriptor.binding; };
    const auto found = std::find_if(pass_.uses.begin(), pass_.uses.end(), at);
    if (found != pass_.uses.end()) return *found;
    throw GraphError(fmt::format("pass '{}': pipeline '{}' has binding {} ('{}'), which the pass did not declare",
                                 pass_.name, pipeline.name(), descriptor.binding, descriptor.name));
}

void PassContext::check_bindings(const vulkan::Pipeline& pipeline, std::size_t push_constant_size) const {
    const auto refuse = [&](const Resource& resource, std::uint32_t binding, const std::string& why) {
        throw GraphError(fmt::format("pass '{}', resource '{}', binding {} of pipeline '{}': {}", pass_.name,
                                     resource.name, binding, pipeline.name(), why));
    };
    const auto& descriptors = pipeline.descriptors();
    for (const Use& use : pass_.uses) {
        if (!use.binding) continue;
        const Resource& resource = graph_.resources()[use.handle.resource];
        const auto descriptor =
            std::find_if(descriptors.begin(), descriptors.end(),
                         [&](const vulkan::DescriptorDeclaration& d) { return d.binding == *use.binding; });
        if (descriptor == descriptors.end()) refuse(resource, *use.binding, "declared, but the pipeline has none");
        const bool in_compute = use.access == Access::compute_read || use.access == Access::compute_write;
        if (in_compute != (pipeline.bind_point() == VK_PIPELINE_BIND_POINT_COMPUTE)) {
            refuse(resource, *use.binding, fmt::format("declared as {}", access_name(use.access)));
        }
        if (resource.is_image != (descriptor->kind == DescriptorKind::storage_image)) {
            refuse(resource, *use.binding, resource.is_image ? "an image, not a buffer" : "a buffer, not an image");
        }
        if (resource.is_image && resource.image.format != descriptor->format) {
            refuse(resource, *use.binding,
                   fmt::format("VkFormat {} declared, the shader has {}", static_cast<int>(resource.image.format),
                               static_cast<int>(descriptor->format)));
        }
        const bool unbound_read = std::any_of(pass_.uses.begin(), pass_.uses.end(), [&](const Use& other) {
            return other.access == Access::compute_read && !other.binding &&
                   other.handle.resource == use.handle.resource;
        });
        const DescriptorAccess declared = !is_write(use.access) ? DescriptorAccess::read
                                          : unbound_read        ? DescriptorAccess::read_write
                                                                : DescriptorAccess::write;
        if (declared != descriptor->access) {
            refuse(resource, *use.binding,
                   fmt::format("the shader {} it, the pass declares that it {}",
                               descriptor_access_name(descriptor->access), descriptor_access_name(declared)));
        }
    }
    if (push_constant_size != pipeline.push_constant_size()) {
        throw GraphError(fmt::format("pass '{}': {} bytes of push constants, pipeline '{}' has {}", pass_.name,
                                     push_constant_size, pipeline.name(), pipeline.push_constant_size()));
    }
}

void PassContext::bind(const vulkan::Pipeline& pipeline, std::span<const std::byte> push_constants) {
    check_bindings(pipeline, push_constants.size());
    const auto& descriptors = pipeline.descriptors();
    std::vector<VkDescriptorImageInfo> images(descriptors.size());
    std::vector<VkDescriptorBufferInfo> buffers(descriptors.size());
    std::vector<VkWriteDescriptorSet> writes(descriptors.size());
    for (std::size_t d = 0; d < descriptors.size(); ++d) {
        const Use& use = use_at(pipeline, descriptors[d]);
        const std::string& name = graph_.resources()[use.handle.resource].name;
        writes[d] = vulkan::structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        writes[d].dstBinding = descriptors[d].binding;
        writes[d].descriptorCount = 1;
        if (descriptors[d].kind == DescriptorKind::storage_image) {
            images[d] = {VK_NULL_HANDLE, pool_.image(name).view(), access_scope(use.access).layout};
            writes[d].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            writes[d].pImageInfo = &images[d];
        } else {
            buffers[d] = {pool_.buffer(name, slot_).handle(), 0, VK_WHOLE_SIZE};
            writes[d].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            writes[d].pBufferInfo = &buffers[d];
        }
    }
    vkCmdBindPipeline(commands_, pipeline.bind_point(), pipeline.handle());
    if (!writes.empty()) {
        vkCmdPushDescriptorSetKHR(commands_, pipeline.bind_point(), pipeline.layout(), 0,
                                  static_cast<std::uint32_t>(writes.size()), writes.data());
    }
    if (!push_constants.empty()) {
        vkCmdPushConstants(commands_, pipeline.layout(), pipeline.push_constant_stages(), 0,
                           static_cast<std::uint32_t>(push_constants.size()), push_constants.data());
    }
}

void PassContext::dispatch_groups(const vulkan::ComputePipeline& pipeline, std::uint32_t width, std::uint32_t height) {
    const auto [x, y, z] = pipeline.local_size();
    const std::uint32_t columns = width / x + (width % x != 0), rows = height / y + (height % y != 0);
    const auto& limit = pool_.device().limits().maxComputeWorkGroupCount;
    if (columns > limit[0] || rows > limit[1]) {
        throw vulkan::VulkanError(fmt::format("pass '{}': {} x {} workgroups, the device's limit is {} x {}",
                                              pass_.name, columns, rows, limit[0], limit[1]));
    }
    vkCmdDispatch(commands_, columns, rows, 1);
}

void PassContext::dispatch_indirect(Handle arguments, std::uint64_t offset) {
    vkCmdDispatchIndirect(commands_, buffer(arguments).handle(), offset);
}

}  // namespace drape::graph
