#include <fmt/core.h>

#include <algorithm>

#include "graph/dump.h"
#include "graph/executor.h"
#include "vulkan/api.h"
#include "vulkan/structure.h"

namespace drape::graph {
namespace {

using vulkan::DescriptorKind;
using vulkan::ReflectedDescriptor;

std::string_view access_text(bool reads, bool writes) {
    if (!writes) return "reads";
    return reads ? "reads and writes" : "writes";
}

const ReflectedDescriptor* find(const vulkan::Pipeline& pipeline, std::string_view variable) {
    const auto found = std::ranges::find(pipeline.descriptors(), variable, &ReflectedDescriptor::name);
    return found == pipeline.descriptors().end() ? nullptr : &*found;
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
    const Resource& resource = graph_.resources()[use_of(handle).handle.resource];
    return pool_.image(handle.slice == UINT32_MAX ? resource.name : resource.image.slices[handle.slice]);
}

const vulkan::Buffer& PassContext::buffer(Handle handle) const {
    return pool_.buffer(graph_.resources()[use_of(handle).handle.resource].name, slot_);
}

VkImageLayout PassContext::layout(Handle handle) const { return access_scope(use_of(handle).access).layout; }

void PassContext::refuse(const vulkan::Pipeline& pipeline, std::string_view variable, const std::string& why) const {
    throw GraphError(fmt::format("pass '{}', '{}' of pipeline '{}': {}", pass_.name, variable, pipeline.name(), why));
}

void PassContext::check_resource(const vulkan::Pipeline& pipeline, std::string_view variable,
                                 const Resource& resource) const {
    const auto unfit = [&](const std::string& why) { refuse(pipeline, variable, "'" + resource.name + "' " + why); };
    const ReflectedDescriptor* const descriptor = find(pipeline, variable);
    if (!descriptor) return unfit("is bound to it, but the shader has no such variable");
    const bool as_image = descriptor->kind == DescriptorKind::storage_image;
    if (descriptor->kind == DescriptorKind::texel_buffer) {
        if (resource.is_image || !resource.buffer.texels) unfit("is no buffer of texels");
        if (descriptor->format != VK_FORMAT_R32G32B32A32_SFLOAT)
            unfit(fmt::format("is rgba32f, the shader has {}", format_name(descriptor->format)));
        return;
    }
    if (!as_image && resource.image.buffer_view) {
        const std::uint32_t texel = vulkan::texel_size(resource.image.format), stride = descriptor->stride;
        // Structs are for passes that write parts of texels, or two texels at a time.
        const bool fits = descriptor->element ? stride > 0 && stride % texel == 0 : stride == texel;
        if (!fits)
            unfit(fmt::format("is a buffer of {} texels, the shader has other elements",
                              format_name(resource.image.format)));
        return;
    }
    if (resource.is_image != as_image)
        unfit(resource.is_image ? "is an image, not a buffer" : "is a buffer, not an image");
    if (resource.is_image) {
        if (resource.image.format != descriptor->format)
            unfit(fmt::format("is {}, the shader has {}", format_name(resource.image.format),
                              format_name(descriptor->format)));
        return;
    }
    if (!resource.buffer.element) return unfit("is declared without the type of its elements");
    const std::string difference = vulkan::element_difference(*descriptor, *resource.buffer.element);
    if (!difference.empty()) unfit("has other elements: " + difference);
}

void PassContext::check_use(const vulkan::Pipeline& pipeline, const Use& use) const {
    const Resource& resource = graph_.resources()[use.handle.resource];
    check_resource(pipeline, use.variable, resource);
    const ReflectedDescriptor& descriptor = *find(pipeline, use.variable);
    const bool unbound_read = std::ranges::any_of(pass_.uses, [&](const Use& other) {
        return other.access == Access::compute_read && other.variable.empty() &&
               other.handle.resource == use.handle.resource;
    });
    const bool writes = is_write(use.access), reads = !writes || unbound_read;
    if (reads != descriptor.readable || writes != descriptor.writable)
        refuse(pipeline, use.variable,
               fmt::format("the shader {} it, the pass declares that it {} '{}'",
                           access_text(descriptor.readable, descriptor.writable), access_text(reads, writes),
                           resource.name));
}

void PassContext::bind_uses(const vulkan::ComputePipeline& pipeline) {
    std::vector<Binding> bindings;
    for (const Use& use : pass_.uses) {
        if (use.variable.empty()) continue;
        check_use(pipeline, use);
        bindings.push_back({use.variable, use.handle});
    }
    bind_descriptors(pipeline, bindings);
}

void PassContext::bind(const vulkan::GraphicsPipeline& pipeline, std::span<const Binding> bindings) {
    struct Stage {
        VkShaderStageFlags flag;
        Access access;
    };
    for (const Binding& binding : bindings) {
        check_resource(pipeline, binding.variable, graph_.resources()[use_of(binding.handle).handle.resource]);
        for (const Stage& stage : {Stage{VK_SHADER_STAGE_VERTEX_BIT, Access::vertex_read},
                                   Stage{VK_SHADER_STAGE_FRAGMENT_BIT, Access::fragment_read}}) {
            const bool declared = std::ranges::any_of(
                pass_.uses, [&](const Use& use) { return use.handle == binding.handle && use.access == stage.access; });
            if ((find(pipeline, binding.variable)->stages & stage.flag) && !declared)
                refuse(pipeline, binding.variable,
                       fmt::format("the pass does not declare {}", access_name(stage.access)));
        }
    }
    bind_descriptors(pipeline, bindings);
}

void PassContext::bind_descriptors(const vulkan::Pipeline& pipeline, std::span<const Binding> bindings) {
    const auto& descriptors = pipeline.descriptors();
    if (bindings.size() > descriptors.size()) refuse(pipeline, bindings.back().variable, "bound twice");
    std::vector<VkDescriptorImageInfo> images(descriptors.size());
    std::vector<VkDescriptorBufferInfo> buffers(descriptors.size());
    std::vector<VkBufferView> texels(descriptors.size());
    std::vector<VkWriteDescriptorSet> writes(descriptors.size());
    for (std::size_t d = 0; d < descriptors.size(); ++d) {
        const auto bound = std::ranges::find(bindings, descriptors[d].name, &Binding::variable);
        if (bound == bindings.end()) refuse(pipeline, descriptors[d].name, "nothing is bound");
        writes[d] = vulkan::structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        writes[d].dstBinding = descriptors[d].binding;
        writes[d].descriptorCount = 1;
        writes[d].descriptorType = vulkan::descriptor_type(pool_.device(), *descriptors[d].kind);
        if (descriptors[d].kind == DescriptorKind::storage_image) {
            images[d] = {VK_NULL_HANDLE, image(bound->handle).view(), layout(bound->handle)};
            writes[d].pImageInfo = &images[d];
        } else if (writes[d].descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER) {
            texels[d] = buffer(bound->handle).texels();
            writes[d].pTexelBufferView = &texels[d];
        } else {
            const bool is_view = graph_.resources()[bound->handle.resource].is_image;
            buffers[d] = {is_view ? image(bound->handle).buffer() : buffer(bound->handle).handle(), 0, VK_WHOLE_SIZE};
            writes[d].pBufferInfo = &buffers[d];
        }
    }
    vkCmdBindPipeline(commands_, pipeline.bind_point(), pipeline.handle());
    if (!writes.empty()) descriptors_.bind(commands_, pipeline, writes);
}

void PassContext::push(const vulkan::Pipeline& pipeline, const PushConstants& push_constants) {
    const std::string difference = vulkan::push_constant_difference(pipeline.push_constants(), push_constants.layout);
    if (!difference.empty()) refuse(pipeline, "push constants", difference);
    if (!push_constants.layout) return;
    // Padding that C++ adds at the end is not part of the pipeline's range.
    vkCmdPushConstants(commands_, pipeline.layout(), pipeline.push_constant_stages(), 0,
                       pipeline.push_constants()->size, push_constants.bytes.data());
}

void PassContext::dispatch(const vulkan::ComputePipeline& pipeline, const PushConstants& push_constants,
                           std::uint32_t width, std::uint32_t height, std::uint32_t depth) {
    bind_uses(pipeline);
    push(pipeline, push_constants);
    const auto [x, y, z] = pipeline.local_size();
    const std::uint32_t columns = width / x + (width % x != 0), rows = height / y + (height % y != 0);
    const auto& limit = pool_.device().limits().maxComputeWorkGroupCount;
    if (columns > limit[0] || rows > limit[1] || depth > limit[2]) {
        throw vulkan::VulkanError(fmt::format("pass '{}': {} x {} x {} workgroups, the device's limit is {} x {} x {}",
                                              pass_.name, columns, rows, depth, limit[0], limit[1], limit[2]));
    }
    vkCmdDispatch(commands_, columns, rows, depth);
}

void PassContext::dispatch_indirect(const vulkan::ComputePipeline& pipeline, const PushConstants& push_constants,
                                    Handle arguments, std::uint64_t offset) {
    bind_uses(pipeline);
    push(pipeline, push_constants);
    vkCmdDispatchIndirect(commands_, buffer(arguments).handle(), offset);
}

}  // namespace drape::graph
