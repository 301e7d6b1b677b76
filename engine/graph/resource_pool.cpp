#include <fmt/core.h>

#include <cstring>
#include <set>

#include "graph/executor.h"
#include "vulkan/api.h"
#include "vulkan/structure.h"

namespace drape::graph {
namespace {

/// One physical resource: its declaration, and its uses by all plans together.
struct Wanted {
    const Resource* resource = nullptr;
    bool used = false;
    std::set<std::uint32_t> slices;  ///< slices that a pass uses on their own
    VkImageUsageFlags image_usage = 0;
    VkBufferUsageFlags buffer_usage = 0;
};

VkImageUsageFlags image_usage(Access access) {
    switch (access) {
        case Access::color_write:
        case Access::resolve_write:
            return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        case Access::depth_write:
            return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
        case Access::transfer_read:
            return VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        case Access::transfer_write:
            return VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        default:
            return VK_IMAGE_USAGE_STORAGE_BIT;
    }
}

VkBufferUsageFlags buffer_usage(Access access) {
    switch (access) {
        case Access::index_read:
            return VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
        case Access::indirect_read:
            return VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
        case Access::transfer_read:
        case Access::transfer_write:
        case Access::host_read:
            return 0;  // every buffer has the transfer usages
        default:
            return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    }
}

bool set_up_once(const Resource& resource) {
    return resource.lifetime == Lifetime::persistent || resource.lifetime == Lifetime::constant;
}

void require_equal(const Resource& one, const Resource& other) {
    const bool equal = one.is_image == other.is_image && one.lifetime == other.lifetime &&
                       one.image.format == other.image.format && one.image.width == other.image.width &&
                       one.image.height == other.image.height && one.image.samples == other.image.samples &&
                       one.image.buffer_view == other.image.buffer_view && one.image.slices == other.image.slices &&
                       one.buffer.byte_count == other.buffer.byte_count && one.buffer.element == other.buffer.element;
    if (!equal) throw GraphError(fmt::format("resource '{}': two graphs declare it differently", one.name));
}

using WantedByName = std::map<std::string, Wanted>;

WantedByName collect(std::span<const std::pair<const Graph*, const Plan*>> plans) {
    WantedByName all;
    for (const auto& [graph, plan] : plans) {
        const auto& resources = graph->resources();
        for (std::size_t r = 0; r < resources.size(); ++r) {
            Wanted& wanted = all[resources[r].name];
            if (wanted.resource) require_equal(*wanted.resource, resources[r]);
            wanted.resource = &resources[r];
            wanted.used = wanted.used || plan->lifespans[r].used();
        }
        for (const PlannedPass& planned : plan->passes) {
            for (const Use& use : graph->passes()[planned.pass].uses) {
                const Resource& resource = resources[use.handle.resource];
                Wanted& wanted = all[resource.name];
                if (resource.is_image) {
                    wanted.image_usage |= image_usage(use.access);
                    if (use.handle.slice != UINT32_MAX) wanted.slices.insert(use.handle.slice);
                } else {
                    wanted.buffer_usage |= buffer_usage(use.access);
                }
            }
        }
    }
    std::erase_if(all, [](const auto& entry) { return !entry.second.used; });
    return all;
}

std::uint64_t total_bytes(const WantedByName& all) {
    std::uint64_t total = 0;
    for (const auto& [name, wanted] : all) {
        std::uint64_t bytes = 0;
        if (__builtin_mul_overflow(wanted.resource->byte_count(), std::uint64_t{copy_count(*wanted.resource)},
                                   &bytes) ||
            __builtin_add_overflow(total, bytes, &total)) {
            throw vulkan::VulkanError(fmt::format("resource '{}': all sizes together exceed 64 bits", name));
        }
    }
    return total;
}

vulkan::ImageDescription describe_image(const Wanted& wanted) {
    const ImageDeclaration& image = wanted.resource->image;
    VkImageUsageFlags usage = wanted.image_usage;
    // Set-up and inspection of intermediate results need this usage. Multisampled images cannot be copied to a buffer,
    // and must be able to stay in tile memory.
    if (image.samples == VK_SAMPLE_COUNT_1_BIT || set_up_once(*wanted.resource)) {
        usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    }
    std::vector<std::string> slices(image.slices.size());
    for (const std::uint32_t slice : wanted.slices) slices[slice] = image.slices[slice];
    // A GPU accesses an image faster if it shares its memory with nothing.
    const bool shares = image.buffer_view || !wanted.slices.empty();
    if (!shares) slices.clear();
    return {image.name, image.format, image.width, image.height, usage, image.samples, shares, slices};
}

vulkan::BufferDescription describe_buffer(const vulkan::Device& device, const Wanted& wanted, std::uint32_t copy) {
    const Resource& resource = *wanted.resource;
    vulkan::BufferDescription description;
    description.name = copy_count(resource) > 1 ? fmt::format("{} (slot {})", resource.name, copy) : resource.name;
    description.byte_count = resource.buffer.byte_count;
    description.usage = wanted.buffer_usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (resource.buffer.texels && device.capabilities().texel_buffers)
        description.usage |= VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    if (resource.lifetime == Lifetime::host_input) description.home = vulkan::BufferHome::upload;
    if (resource.lifetime == Lifetime::host_output) description.home = vulkan::BufferHome::readback;
    return description;
}

void record_to_general(VkCommandBuffer commands, const vulkan::Image& image) {
    auto barrier = vulkan::structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = {image.aspect(), 0, 1, 0, 1};
    auto dependency = vulkan::structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

void record_clear(VkCommandBuffer commands, const vulkan::Image& image) {
    record_to_general(commands, image);
    const VkImageSubresourceRange range{image.aspect(), 0, 1, 0, 1};
    if (image.aspect() & VK_IMAGE_ASPECT_DEPTH_BIT) {
        const VkClearDepthStencilValue zero{};
        vkCmdClearDepthStencilImage(commands, image.handle(), VK_IMAGE_LAYOUT_GENERAL, &zero, 1, &range);
    } else {
        const VkClearColorValue zero{};
        vkCmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_GENERAL, &zero, 1, &range);
    }
}

}  // namespace

ResourcePool::ResourcePool(const vulkan::Device& device, std::span<const std::pair<const Graph*, const Plan*>> plans)
    : device_(device) {
    const WantedByName all = collect(plans);
    device.budget().require(total_bytes(all), fmt::format("the {} images and buffers of the plans", all.size()));
    for (const auto& [name, wanted] : all) {
        if (wanted.resource->is_image) {
            const vulkan::Image& image =
                images_.emplace(name, vulkan::Image(device, describe_image(wanted))).first->second;
            for (const vulkan::Image& slice : image.slices()) slices_.emplace(slice.description().name, &slice);
            continue;
        }
        std::vector<vulkan::Buffer>& copies = buffers_[name];
        for (std::uint32_t copy = 0; copy < copy_count(*wanted.resource); ++copy) {
            copies.emplace_back(device, describe_buffer(device, wanted, copy));
        }
    }
    device.run_once([&](VkCommandBuffer commands) {
        // Slices come first, since their memory is cleared with the whole.
        for (const auto& [name, slice] : slices_) record_to_general(commands, *slice);
        for (const auto& [name, image] : images_) {
            const Resource& resource = *all.at(name).resource;
            if (set_up_once(resource) || resource.image.stays_general()) record_clear(commands, image);
        }
        for (const auto& [name, copies] : buffers_) {
            for (const vulkan::Buffer& buffer : copies) {
                if (!buffer.mapped().empty()) {
                    std::memset(buffer.mapped().data(), 0, buffer.mapped().size());
                } else {
                    vkCmdFillBuffer(commands, buffer.handle(), 0, VK_WHOLE_SIZE, 0);
                }
            }
        }
    });
}

std::uint64_t planned_bytes(std::span<const std::pair<const Graph*, const Plan*>> plans) {
    return total_bytes(collect(plans));
}

std::string buffer_view_obstacle(const vulkan::Device& device, const ImageDeclaration& image, std::uint32_t row_pitch) {
    constexpr VkImageUsageFlags usage =
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return vulkan::Image::obstacle(
        device, {image.name, image.format, image.width, image.height, usage, image.samples, true, image.slices},
        row_pitch);
}

bool ResourcePool::has(const std::string& name) const {
    return images_.contains(name) || slices_.contains(name) || buffers_.contains(name);
}

const vulkan::Image& ResourcePool::image(const std::string& name) const {
    const auto place = images_.find(name);
    if (place != images_.end()) return place->second;
    if (const auto slice = slices_.find(name); slice != slices_.end()) return *slice->second;
    throw GraphError(fmt::format("image '{}': {}", name,
                                 buffers_.contains(name) ? "it is a buffer" : "no plan uses it, or none is declared"));
}

const vulkan::Buffer& ResourcePool::buffer(const std::string& name, std::uint32_t slot) const {
    const auto place = buffers_.find(name);
    if (place == buffers_.end()) {
        throw GraphError(
            fmt::format("buffer '{}': {}", name,
                        images_.contains(name) ? "it is an image" : "no plan uses it, or none is declared"));
    }
    return place->second.size() == 1 ? place->second.front() : place->second.at(slot);
}

}  // namespace drape::graph
