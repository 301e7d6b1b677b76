#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "vulkan/api.h"
#include "vulkan/resources.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

[[noreturn]] void refuse(const ImageDescription& description, const std::string& why) {
    throw VulkanError(
        fmt::format("image {} ({} x {}): {}", description.name, description.width, description.height, why));
}

VkImageCreateInfo create_info(const ImageDescription& description) {
    auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = description.format;
    info.extent = {description.width, description.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = description.samples;
    info.tiling = description.buffer_view ? VK_IMAGE_TILING_LINEAR : VK_IMAGE_TILING_OPTIMAL;
    info.usage = description.usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    return info;
}

/// Throws unless the device and its memory budget allow the image. This check precedes the creation of anything, since
/// drivers report it only when the memory is bound, or never.
void require_possible(const Device& device, const ImageDescription& description) {
    if (description.width == 0 || description.height == 0) refuse(description, "both sides must be at least 1");
    const std::uint32_t side = device.limits().maxImageDimension2D;
    if (description.width > side || description.height > side) {
        refuse(description, fmt::format("the device's limit is {} x {}", side, side));
    }
    const VkImageCreateInfo info = create_info(description);
    VkImageFormatProperties properties;
    const VkResult result = vkGetPhysicalDeviceImageFormatProperties(device.physical(), info.format, info.imageType,
                                                                     info.tiling, info.usage, info.flags, &properties);
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) {
        refuse(description,
               fmt::format("the device has no {}images of VkFormat {} with the usage {:#x}",
                           description.buffer_view ? "LINEAR " : "", static_cast<int>(info.format), info.usage));
    }
    check(result, "vkGetPhysicalDeviceImageFormatProperties", description.name);
    if (description.width > properties.maxExtent.width || description.height > properties.maxExtent.height) {
        refuse(description, fmt::format("the device's limit for this format and usage is {} x {}",
                                        properties.maxExtent.width, properties.maxExtent.height));
    }
    if (!(properties.sampleCounts & static_cast<VkSampleCountFlags>(description.samples))) {
        refuse(description, fmt::format("the device has no {} samples for this format and usage",
                                        static_cast<int>(description.samples)));
    }
    // The sides are within the device's limit, so the product fits into 64 bits.
    const std::uint64_t bytes = std::uint64_t{description.width} * description.height * texel_size(description.format) *
                                static_cast<std::uint32_t>(description.samples);
    if (bytes > properties.maxResourceSize) {
        refuse(description, fmt::format("{} bytes, the device's limit is {}", bytes, properties.maxResourceSize));
    }
    device.budget().require(bytes, "image " + description.name);
}

}  // namespace

std::uint32_t texel_size(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
        case VK_FORMAT_R8_UINT:
            return 1;
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_R8G8B8A8_UINT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SINT:
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_D32_SFLOAT:
            return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R32G32_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            throw VulkanError(fmt::format("VkFormat {} is none that Drape uses", static_cast<int>(format)));
    }
}

Image::Image(const Device& device, const ImageDescription& description, Empty)
    : device_(&device), description_(description) {}

Image::Image(const Device& device, const ImageDescription& description) : Image(device, description, Empty{}) {
    VkMemoryRequirements requirements = make_handles();
    make_slices(requirements);
    memory_ = device.allocate(requirements, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "image " + description.name);
    byte_count_ = requirements.size;
    bind(memory_, 0);
    for (std::size_t k = 0; k < slices_.size(); ++k) slices_[k].bind(memory_, slice_offsets_[k]);
}

std::string Image::obstacle(const Device& device, const ImageDescription& description, std::uint32_t row_pitch) {
    try {
        Image image(device, description, Empty{});
        VkMemoryRequirements requirements = image.make_handles();
        image.make_slices(requirements);
        if (row_pitch != 0 && image.row_pitch() != row_pitch)
            return fmt::format("its rows are {} texels apart, not {}", image.row_pitch(), row_pitch);
    } catch (const VulkanError& error) {
        // A call that fails for another reason (no memory, a lost device) says nothing about such images.
        if (error.is_failed_call() && error.result() != VK_ERROR_FORMAT_NOT_SUPPORTED) throw;
        return error.what();
    }
    return {};
}

VkMemoryRequirements Image::make_handles() {
    require_possible(*device_, description_);
    const VkImageCreateInfo info = create_info(description_);
    create_handle(vkCreateImage, device_->handle(), info, handle_, "vkCreateImage", description_.name);
    device_->set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(handle_), description_.name);
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device_->handle(), handle_, &requirements);
    if (description_.buffer_view) make_buffer(requirements);
    return requirements;
}

void Image::make_buffer(VkMemoryRequirements& requirements) {
    const VkImageSubresource texels{aspect(), 0, 0};
    VkSubresourceLayout layout;
    vkGetImageSubresourceLayout(device_->handle(), handle_, &texels, &layout);
    const std::uint32_t texel = texel_size(description_.format);
    if (layout.offset != 0 || layout.rowPitch % texel != 0)
        refuse(description_, "the device lays its rows so that they are no array of texels");
    row_pitch_ = static_cast<std::uint32_t>(layout.rowPitch / texel);
    const std::uint64_t bytes = layout.rowPitch * description_.height;
    const std::uint64_t limit =
        std::min<std::uint64_t>(device_->limits().maxStorageBufferRange, device_->capabilities().max_buffer_size);
    if (bytes > limit)
        refuse(description_, fmt::format("a buffer view of {} bytes, the device's limit is {}", bytes, limit));
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    create_handle(vkCreateBuffer, device_->handle(), info, buffer_, "vkCreateBuffer", description_.name);
    device_->set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), description_.name);
    VkMemoryRequirements needed;
    vkGetBufferMemoryRequirements(device_->handle(), buffer_, &needed);
    requirements.size = std::max(requirements.size, needed.size);
    requirements.alignment = std::max(requirements.alignment, needed.alignment);
    requirements.memoryTypeBits &= needed.memoryTypeBits;
    if (requirements.memoryTypeBits == 0) refuse(description_, "no memory of the device serves an image and a buffer");
}

VkDeviceSize Image::slice_byte_count() const {
    return VkDeviceSize{row_pitch_} * texel_size(description_.format) *
           (description_.height / description_.slices.size());
}

void Image::make_slices(VkMemoryRequirements& requirements) {
    const auto count = static_cast<std::uint32_t>(description_.slices.size());
    if (count == 0) return;
    if (!description_.buffer_view || description_.height % count != 0)
        refuse(description_, fmt::format("it cannot be cut into {} slices", count));
    for (std::uint32_t k = 0; k < count; ++k) {
        if (description_.slices[k].empty()) continue;
        ImageDescription band = description_;
        band.name = description_.slices[k], band.height /= count, band.slices.clear();
        const VkDeviceSize offset = k * slice_byte_count();
        Image slice(*device_, band, Empty{});
        const VkMemoryRequirements needed = slice.make_handles();
        if (slice.row_pitch() != row_pitch_ || offset % needed.alignment != 0)
            refuse(description_, "the device does not lay its slices where its rows are");
        requirements.size = std::max(requirements.size, offset + needed.size);
        requirements.alignment = std::max(requirements.alignment, needed.alignment);
        requirements.memoryTypeBits &= needed.memoryTypeBits;
        slices_.push_back(std::move(slice));
        slice_offsets_.push_back(offset);
    }
    if (requirements.memoryTypeBits == 0) refuse(description_, "no memory of the device serves it and its slices");
}

void Image::bind(VkDeviceMemory memory, VkDeviceSize offset) {
    check(vkBindImageMemory(device_->handle(), handle_, memory, offset), "vkBindImageMemory", description_.name);
    if (buffer_)
        check(vkBindBufferMemory(device_->handle(), buffer_, memory, offset), "vkBindBufferMemory", description_.name);
    // An image that is only copied cannot have a view.
    constexpr VkImageUsageFlags transfer = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (!(description_.usage & ~transfer)) return;
    auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = handle_;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = description_.format;
    info.subresourceRange = {aspect(), 0, 1, 0, 1};
    create_handle(vkCreateImageView, device_->handle(), info, view_, "vkCreateImageView", description_.name);
    device_->set_name(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<std::uint64_t>(view_), description_.name);
}

Image::~Image() {
    if (!handle_) return;
    slices_.clear();
    vkDestroyImageView(device_->handle(), view_, nullptr);
    vkDestroyImage(device_->handle(), handle_, nullptr);
    vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    device_->free(memory_, byte_count_);
}

Image::Image(Image&& other) noexcept
    : device_(other.device_),
      description_(std::move(other.description_)),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      view_(std::exchange(other.view_, VK_NULL_HANDLE)),
      buffer_(std::exchange(other.buffer_, VK_NULL_HANDLE)),
      row_pitch_(other.row_pitch_),
      byte_count_(std::exchange(other.byte_count_, 0)),
      slices_(std::move(other.slices_)),
      slice_offsets_(std::move(other.slice_offsets_)) {}

VkImageAspectFlags Image::aspect() const {
    return description_.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

}  // namespace drape::vulkan
