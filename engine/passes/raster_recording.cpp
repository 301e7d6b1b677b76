#include "passes/raster_recording.h"

#include <fmt/core.h>
#include <volk.h>

#include <algorithm>

namespace drape {
namespace {

VkRenderingAttachmentInfo attachment(const graph::PassContext& context, graph::Handle handle, bool keep) {
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView = context.image(handle).view();
    info.imageLayout = context.layout(handle);
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = keep ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return info;
}

graph::GraphError mismatch(const vulkan::Pipeline& pipeline, std::uint32_t binding, std::string_view problem) {
    return graph::GraphError(fmt::format("pipeline '{}', binding {}: {}", pipeline.name(), binding, problem));
}

/// Where the info structs of one push live; never resized, because the writes point into it.
struct PushedDescriptors {
    explicit PushedDescriptors(std::size_t count) : images(count), buffers(count), writes(count) {}
    std::vector<VkDescriptorImageInfo> images;
    std::vector<VkDescriptorBufferInfo> buffers;
    std::vector<VkWriteDescriptorSet> writes;
};

}  // namespace

void begin_rendering(const graph::PassContext& context, const RasterAttachments& attachments) {
    const vulkan::Image& target = context.image(attachments.color);
    const bool resolved = attachments.resolve.valid();
    VkRenderingAttachmentInfo color = attachment(context, attachments.color, !resolved);
    color.clearValue.color = {{1.0f, 1.0f, 1.0f, 1.0f}};
    if (resolved) {
        color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        color.resolveImageView = context.image(attachments.resolve).view();
        color.resolveImageLayout = context.layout(attachments.resolve);
    }
    VkRenderingAttachmentInfo depth = attachment(context, attachments.depth, false);
    depth.clearValue.depthStencil = {1.0f, 0};
    const VkExtent2D extent{target.description().width, target.description().height};
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = extent;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &color;
    rendering.pDepthAttachment = &depth;
    vkCmdBeginRendering(context.commands(), &rendering);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(context.commands(), 0, 1, &viewport);
    vkCmdSetScissor(context.commands(), 0, 1, &scissor);
}

void bind_pipeline(const graph::PassContext& context, const vulkan::GraphicsPipeline& pipeline) {
    vkCmdBindPipeline(context.commands(), pipeline.bind_point(), pipeline.handle());
}

void push_bindings(const graph::PassContext& context, const vulkan::GraphicsPipeline& pipeline,
                   const std::vector<BoundHandle>& bound) {
    const std::vector<vulkan::DescriptorDeclaration>& descriptors = pipeline.descriptors();
    PushedDescriptors pushed(descriptors.size());
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        const vulkan::DescriptorDeclaration& descriptor = descriptors[i];
        const auto is_it = [&](const BoundHandle& candidate) { return candidate.binding == descriptor.binding; };
        const auto match = std::find_if(bound.begin(), bound.end(), is_it);
        if (match == bound.end()) throw mismatch(pipeline, descriptor.binding, "nothing is bound");
        VkWriteDescriptorSet& write = pushed.writes[i];
        write = {};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstBinding = descriptor.binding;
        write.descriptorCount = 1;
        if (descriptor.kind == vulkan::DescriptorKind::storage_image) {
            const vulkan::Image& image = context.image(match->handle);
            if (image.description().format != descriptor.format)
                throw mismatch(pipeline, descriptor.binding, "the image has another format");
            pushed.images[i] = {VK_NULL_HANDLE, image.view(), context.layout(match->handle)};
            write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            write.pImageInfo = &pushed.images[i];
        } else {
            pushed.buffers[i] = {context.buffer(match->handle).handle(), 0, VK_WHOLE_SIZE};
            write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            write.pBufferInfo = &pushed.buffers[i];
        }
    }
    if (bound.size() != descriptors.size())
        throw graph::GraphError(fmt::format("pipeline '{}' has {} descriptors, but {} are bound", pipeline.name(),
                                            descriptors.size(), bound.size()));
    vkCmdPushDescriptorSetKHR(context.commands(), pipeline.bind_point(), pipeline.layout(), 0,
                              static_cast<std::uint32_t>(pushed.writes.size()), pushed.writes.data());
}

void draw_cloth(const graph::PassContext& context, const vulkan::GraphicsPipeline& pipeline,
                const glsl::ClothPush& push, graph::Handle indices, std::uint32_t index_count) {
    vkCmdPushConstants(context.commands(), pipeline.layout(), pipeline.push_constant_stages(), 0, sizeof(push), &push);
    vkCmdBindIndexBuffer(context.commands(), context.buffer(indices).handle(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(context.commands(), index_count, 1, 0, 0, 0);
}

void draw_colliders(const graph::PassContext& context, const ColliderDraw& range) {
    vkCmdDraw(context.commands(), range.vertex_count, range.instance_count, 0, range.first_instance);
}

void copy_to_buffer(const graph::PassContext& context, graph::Handle image, graph::Handle buffer) {
    const vulkan::Image& source = context.image(image);
    VkBufferImageCopy region{};
    region.imageSubresource = {source.aspect(), 0, 0, 1};
    region.imageExtent = {source.description().width, source.description().height, 1};
    vkCmdCopyImageToBuffer(context.commands(), source.handle(), context.layout(image), context.buffer(buffer).handle(),
                           1, &region);
}

}  // namespace drape
