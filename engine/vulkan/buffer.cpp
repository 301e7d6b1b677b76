#include <fmt/format.h>

#include <utility>

#include "vulkan/api.h"
#include "vulkan/resources.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

constexpr VkMemoryPropertyFlags host_coherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

[[noreturn]] void refuse(const BufferDescription& description, const std::string& why) {
    throw VulkanError(fmt::format("buffer {} ({} bytes): {}", description.name, description.byte_count, why));
}

void require_possible(const Device& device, const BufferDescription& description) {
    if (description.byte_count == 0) refuse(description, "the size must be at least 1");
    if (description.byte_count > device.capabilities().max_buffer_size) {
        refuse(description, fmt::format("the device's limit is {} bytes", device.capabilities().max_buffer_size));
    }
    const std::uint64_t range = device.limits().maxStorageBufferRange;
    if ((description.usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) && description.byte_count > range) {
        refuse(description, fmt::format("the device's limit for a storage buffer is {} bytes", range));
    }
    const std::uint64_t texels = device.limits().maxTexelBufferElements;
    if ((description.usage & VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT) && description.byte_count / 16 > texels) {
        refuse(description, fmt::format("the device's limit for a texel buffer is {} texels", texels));
    }
    device.budget().require(description.byte_count, "buffer " + description.name);
}

}  // namespace

Buffer::Buffer(const Device& device, const BufferDescription& description, Empty)
    : device_(&device), description_(description) {}

Buffer::Buffer(const Device& device, const BufferDescription& description) : Buffer(device, description, Empty{}) {
    require_possible(device, description);
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = description.byte_count;
    info.usage = description.usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    create_handle(vkCreateBuffer, device.handle(), info, handle_, "vkCreateBuffer", description.name);
    device.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle_), description.name);
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle(), handle_, &requirements);
    VkMemoryPropertyFlags required = 0, preferred = 0;
    switch (description.home) {
        case BufferHome::device:
            preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
            break;
        case BufferHome::upload:
            required = host_coherent;
            break;
        case BufferHome::readback:
            required = host_coherent;
            preferred = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
            break;
    }
    memory_ = device.allocate(requirements, required, preferred, "buffer " + description.name);
    allocated_ = requirements.size;
    check(vkBindBufferMemory(device.handle(), handle_, memory_, 0), "vkBindBufferMemory", description.name);
    if (description.home != BufferHome::device) map();
    if (description.usage & VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT) make_texels();
}

void Buffer::make_texels() {
    auto info = structure<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
    info.buffer = handle_;
    info.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    info.range = VK_WHOLE_SIZE;
    create_handle(vkCreateBufferView, device_->handle(), info, texels_, "vkCreateBufferView", description_.name);
}

void Buffer::map() {
    void* address = nullptr;
    check(vkMapMemory(device_->handle(), memory_, 0, VK_WHOLE_SIZE, 0, &address), "vkMapMemory", description_.name);
    mapped_ = static_cast<std::byte*>(address);
}

Buffer::~Buffer() {
    if (!handle_) return;
    vkDestroyBufferView(device_->handle(), texels_, nullptr);
    vkDestroyBuffer(device_->handle(), handle_, nullptr);
    device_->free(memory_, allocated_);  // freeing unmaps it
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_),
      description_(std::move(other.description_)),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
      texels_(std::exchange(other.texels_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      mapped_(std::exchange(other.mapped_, nullptr)),
      allocated_(std::exchange(other.allocated_, 0)) {}

}  // namespace drape::vulkan
