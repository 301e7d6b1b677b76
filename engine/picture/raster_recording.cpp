#include "picture/raster_recording.h"

#include "vulkan/api.h"

namespace drape {
namespace {

VkRenderingAttachmentInfo attachment(const graph::PassContext& context, graph::Handle handle, bool clear, bool keep) {
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView = context.image(handle).view();
    info.imageLayout = context.layout(handle);
    info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    info.storeOp = keep ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return info;
}

}  // namespace

void begin_rendering(const graph::PassContext& context, const RasterAttachments& attachments) {
    const vulkan::Image& target = context.image(attachments.color);
    const bool resolved = attachments.resolve.valid();
    VkRenderingAttachmentInfo color =
        attachment(context, attachments.color, attachments.cleared.has_value(), !resolved);
    if (attachments.cleared) color.clearValue.color = *attachments.cleared;
    if (resolved) {
        color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        color.resolveImageView = context.image(attachments.resolve).view();
        color.resolveImageLayout = context.layout(attachments.resolve);
    }
    VkRenderingAttachmentInfo depth{};
    if (attachments.depth.valid()) {
        depth = attachment(context, attachments.depth, attachments.cleared.has_value(), false);
        depth.clearValue.depthStencil = {1.0f, 0};
    }
    const VkExtent2D extent{target.description().width, target.description().height};
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = extent;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &color;
    if (attachments.depth.valid()) rendering.pDepthAttachment = &depth;
    vkCmdBeginRendering(context.commands(), &rendering);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(context.commands(), 0, 1, &viewport);
    vkCmdSetScissor(context.commands(), 0, 1, &scissor);
}

void draw_cloth(graph::PassContext& context, graph::Handle indices, std::uint32_t index_count) {
    vkCmdBindIndexBuffer(context.commands(), context.buffer(indices).handle(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(context.commands(), index_count, 1, 0, 0, 0);
}

void draw_colliders(const graph::PassContext& context, const ColliderDraw& range) {
    vkCmdDraw(context.commands(), range.vertex_count, range.instance_count, range.first_vertex, range.first_instance);
}

std::vector<vulkan::SpecializationConstant> body_constants(const ColliderDraw& range) {
    std::vector<vulkan::SpecializationConstant> constants{{"collider_kind", static_cast<std::uint32_t>(range.kind)}};
    if (range.has_corners)
        constants.emplace_back("is_mesh", 1u);
    else
        constants.emplace_back("round_columns", range.round_columns);
    return constants;
}

VkCullModeFlags body_cull(const ColliderDraw& range) {
    // A bounded body is closed: its inner side is not visible from outside.
    return range.casts_shadow && range.closed ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
}

}  // namespace drape
