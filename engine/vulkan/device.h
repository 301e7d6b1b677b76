// One logical device, one queue, its limits and the memory budget.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "vulkan/instance.h"

namespace drape::vulkan {

/// Bytes promised and bytes taken, in checked 64-bit. `reserve` throws VulkanError naming the object when
/// the limit would be exceeded (robustness.md 2: an image too large fails only at bind on lavapipe).
class MemoryBudget {
  public:
    explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}
    void reserve(std::uint64_t bytes, std::string_view object);
    void release(std::uint64_t bytes);
    std::uint64_t used() const { return used_; }
    std::uint64_t limit() const { return limit_; }
    /// Throws before anything is allocated when `bytes` more would not fit.
    void require(std::uint64_t bytes, std::string_view what) const;

  private:
    std::uint64_t limit_;
    std::uint64_t used_ = 0;
};

class Device {
  public:
    /// `selector`: empty (a GPU is preferred when there is one), INDEX, NAME (unique, case-insensitive
    /// part), UUID or "cpu". Throws VulkanError listing the devices and why each was rejected.
    Device(const Instance& instance, std::string_view selector);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const Instance& instance() const { return instance_; }
    const DeviceInfo& info() const { return info_; }
    VkDevice handle() const { return handle_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
    std::uint32_t timestamp_valid_bits() const { return timestamp_valid_bits_; }
    MemoryBudget& budget() const { return budget_; }

    /// First memory type of `type_bits` with all of `required`, preferring `preferred`.
    std::uint32_t memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags required,
                              VkMemoryPropertyFlags preferred) const;
    void wait_idle() const;
    /// Records with `record`, submits, waits: for set-up and tests, never in the frame loop.
    void run_once(const std::function<void(VkCommandBuffer)>& record) const;
    /// VK_EXT_debug_utils name, when validation is on.
    void set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

  private:
    const Instance& instance_;
    DeviceInfo info_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDevice handle_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool once_pool_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    std::uint32_t timestamp_valid_bits_ = 0;
    mutable MemoryBudget budget_{0};
};

}  // namespace drape::vulkan
