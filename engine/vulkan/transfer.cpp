#include <fmt/format.h>

#include <cstring>
#include <map>

#include "vulkan/api.h"
#include "vulkan/resources.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

void require_size(const std::string& object, std::uint64_t has, std::uint64_t given) {
    if (has != given) throw VulkanError(fmt::format("{} holds {} bytes, the transfer has {}", object, has, given));
}

void require_transferable(const Image& image, std::uint64_t bytes, VkImageUsageFlags usage) {
    const ImageDescription& description = image.description();
    const std::string object = "image " + description.name;
    if (description.samples != VK_SAMPLE_COUNT_1_BIT) {
        throw VulkanError(object + " has several samples: it cannot be copied");
    }
    if (!(description.usage & usage)) throw VulkanError(object + " was made without the transfer usage");
    require_size(object, std::uint64_t{description.width} * description.height * texel_size(description.format), bytes);
}

void require_transferable(const Buffer& buffer, std::uint64_t bytes, VkBufferUsageFlags usage) {
    const BufferDescription& description = buffer.description();
    const std::string object = "buffer " + description.name;
    require_size(object, description.byte_count, bytes);
    if (buffer.mapped().empty() && !(description.usage & usage)) {
        throw VulkanError(object + " was made without the transfer usage");
    }
}

/// Waits for all earlier work on the queue and makes it visible to all later work, the host included. This strong
/// barrier is acceptable, since these transfers are not part of the frame loop.
void full_barrier(VkCommandBuffer commands) {
    auto barrier = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

/// Transitions from UNDEFINED to GENERAL: the contents are lost, and earlier uses only have to finish.
void discard_to_general(VkCommandBuffer commands, const Image& image) {
    auto barrier = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = {image.aspect(), 0, 1, 0, 1};
    auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

VkBufferImageCopy whole(const Image& image) {
    VkBufferImageCopy region{};  // row length 0 means tightly packed
    region.imageSubresource = {image.aspect(), 0, 0, 1};
    region.imageExtent = {image.description().width, image.description().height, 1};
    return region;
}

Buffer staging(const Device& device, const std::string& name, std::uint64_t bytes, BufferHome home) {
    const VkBufferUsageFlags usage =
        home == BufferHome::upload ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    return Buffer(device, {.name = name + " staging", .byte_count = bytes, .usage = usage, .home = home});
}

void copy(VkCommandBuffer commands, const Buffer& from, const Buffer& to) {
    const VkBufferCopy region{0, 0, from.description().byte_count};
    full_barrier(commands);
    vkCmdCopyBuffer(commands, from.handle(), to.handle(), 1, &region);
    full_barrier(commands);
}

}  // namespace

void upload(const Device& device, const Image& image, std::span<const std::byte> bytes) {
    require_transferable(image, bytes.size(), VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const Buffer source = staging(device, image.description().name, bytes.size(), BufferHome::upload);
    std::memcpy(source.mapped().data(), bytes.data(), bytes.size());
    device.run_once([&](VkCommandBuffer commands) {
        discard_to_general(commands, image);
        const VkBufferImageCopy region = whole(image);
        vkCmdCopyBufferToImage(commands, source.handle(), image.handle(), VK_IMAGE_LAYOUT_GENERAL, 1, &region);
        full_barrier(commands);
    });
}

void upload(const Device& device, const Buffer& buffer, std::span<const std::byte> bytes) {
    require_transferable(buffer, bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    if (!buffer.mapped().empty()) {
        std::memcpy(buffer.mapped().data(), bytes.data(), bytes.size());  // the next submit makes it visible
        return;
    }
    const Buffer source = staging(device, buffer.description().name, bytes.size(), BufferHome::upload);
    std::memcpy(source.mapped().data(), bytes.data(), bytes.size());
    device.run_once([&](VkCommandBuffer commands) { copy(commands, source, buffer); });
}

void upload_rows(const Device& device, const Image& image, std::uint32_t first_row, std::span<const std::byte> bytes) {
    const RowsOfImage part{&image, first_row, {bytes.begin(), bytes.end()}};
    upload_rows(device, std::span(&part, 1));
}

void upload_rows(const Device& device, std::span<const RowsOfImage> parts) {
    std::map<const Image*, std::vector<VkBufferImageCopy>> regions;
    std::vector<std::byte> all;
    for (const RowsOfImage& part : parts) {
        const ImageDescription& description = part.image->description();
        const std::uint64_t row = std::uint64_t{description.width} * texel_size(description.format);
        const std::uint64_t count = part.bytes.size() / row;
        if (part.bytes.size() % row != 0 || part.first_row + count > description.height)
            throw VulkanError(fmt::format("image {} has no {} bytes from row {} on", description.name,
                                          part.bytes.size(), part.first_row));
        if (count == 0) continue;
        VkBufferImageCopy& region = regions[part.image].emplace_back(whole(*part.image));
        region.bufferOffset = all.size();
        region.imageOffset.y = static_cast<std::int32_t>(part.first_row);
        region.imageExtent.height = static_cast<std::uint32_t>(count);
        all.insert(all.end(), part.bytes.begin(), part.bytes.end());
        all.resize((all.size() + 15) / 16 * 16);  // a region begins at a texel
    }
    if (regions.empty()) return;
    const Buffer source = staging(device, parts.front().image->description().name, all.size(), BufferHome::upload);
    std::memcpy(source.mapped().data(), all.data(), all.size());
    device.run_once([&](VkCommandBuffer commands) {
        full_barrier(commands);
        for (const auto& [image, copies] : regions)
            vkCmdCopyBufferToImage(commands, source.handle(), image->handle(), VK_IMAGE_LAYOUT_GENERAL,
                                   static_cast<std::uint32_t>(copies.size()), copies.data());
        full_barrier(commands);
    });
}

void upload_range(const Device& device, const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> bytes) {
    const BufferDescription& description = buffer.description();
    if (offset + bytes.size() > description.byte_count)
        throw VulkanError(fmt::format("buffer {} has no {} bytes at {}", description.name, bytes.size(), offset));
    if (bytes.empty()) return;
    if (!buffer.mapped().empty()) {
        std::memcpy(buffer.mapped().data() + offset, bytes.data(), bytes.size());  // the next submit makes it visible
        return;
    }
    const Buffer source = staging(device, description.name, bytes.size(), BufferHome::upload);
    std::memcpy(source.mapped().data(), bytes.data(), bytes.size());
    device.run_once([&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, offset, bytes.size()};
        full_barrier(commands);
        vkCmdCopyBuffer(commands, source.handle(), buffer.handle(), 1, &region);
        full_barrier(commands);
    });
}

void download(const Device& device, const Image& image, std::span<std::byte> bytes) {
    require_transferable(image, bytes.size(), VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const Buffer target = staging(device, image.description().name, bytes.size(), BufferHome::readback);
    device.run_once([&](VkCommandBuffer commands) {
        full_barrier(commands);
        const VkBufferImageCopy region = whole(image);
        vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_GENERAL, target.handle(), 1, &region);
        full_barrier(commands);
    });
    std::memcpy(bytes.data(), target.mapped().data(), bytes.size());
}

void download(const Device& device, const Buffer& buffer, std::span<std::byte> bytes) {
    require_transferable(buffer, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    if (!buffer.mapped().empty()) {
        device.run_once([](VkCommandBuffer commands) { full_barrier(commands); });
        std::memcpy(bytes.data(), buffer.mapped().data(), bytes.size());
        return;
    }
    const Buffer target = staging(device, buffer.description().name, bytes.size(), BufferHome::readback);
    device.run_once([&](VkCommandBuffer commands) { copy(commands, buffer, target); });
    std::memcpy(bytes.data(), target.mapped().data(), bytes.size());
}

}  // namespace drape::vulkan
