#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

#include "vulkan/instance.h"

namespace drape::vulkan {

/// Keeps account of bytes promised and taken, in checked 64-bit. `reserve` throws VulkanError naming the object when
/// the limit would be exceeded (docs/devices.md: an image too large fails only at bind on lavapipe).
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

/// Returns 90 % of the largest device-local heap; on a CPU device, where that heap is the machine's memory, at most 75
/// % of what the system says is available.
std::uint64_t memory_budget_limit(const VkPhysicalDeviceMemoryProperties& memory, bool cpu);

/// What a device has, and offers beyond what every device must (device_requirements.h).
struct DeviceCapabilities {
    VkPhysicalDeviceLimits limits{};
    std::uint32_t timestamp_valid_bits = 0;
    bool wide_integers = false;         ///< shaders have integers of 64 bits
    bool wide_atomics = false;          ///< they may add such integers in buffers atomically
    bool samples_in_shaders = false;    ///< they may load each of four samples of storage images
    bool full_subgroups = false;        ///< compute shaders can be promised that all of theirs are full
    std::uint32_t subgroup = 0;         ///< invocations in one
    std::uint32_t shuffling_lanes = 0;  ///< of a subgroup of compute shaders; 0 where they cannot shuffle
    bool shuffles(std::uint32_t lanes) const { return shuffling_lanes == lanes; }
    bool push_descriptors = false;  ///< else sets are bound
    std::uint32_t max_push_descriptors = 0;
    bool texel_buffers = false;     ///< else shaders have storage buffers in their place (texel_storage.h)
    std::uint64_t most_texels = 0;  ///< of either, 16 bytes each
    std::uint64_t max_buffer_size = 0;
    std::uint64_t max_allocation_size = 0;
};

class ComputePipeline;
struct SpecializationConstant;

class Device {
  public:
    /// `selector`: INDEX, NAME (unique, case-insensitive part), UUID or "cpu"; empty: what the environment variable
    /// DRAPE_DEVICE says, else a GPU when there is one. Throws VulkanError listing the devices and why each was
    /// rejected. `without`: names of optional requirements (device_requirements.h) that it is used as if it lacked, for
    /// tests of what is done there. The instance must outlive the device.
    Device(const Instance& instance, std::string_view selector, std::span<const std::string_view> without = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const Instance& instance() const { return instance_; }
    const DeviceInfo& info() const { return info_; }
    VkDevice handle() const { return handle_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    const VkPhysicalDeviceLimits& limits() const { return capabilities_.limits; }
    const DeviceCapabilities& capabilities() const { return capabilities_; }
    MemoryBudget& budget() const { return budget_; }

    /// Returns the first memory type of `type_bits` with all of `required`, preferring `preferred`.
    std::uint32_t memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags required,
                              VkMemoryPropertyFlags preferred) const;
    /// Allocates memory for one resource: its bytes are reserved from the budget first, and given back when the
    /// allocation fails. `object` names the resource in errors.
    VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                            VkMemoryPropertyFlags preferred, std::string_view object) const;
    /// Frees what `allocate` gave (nothing for VK_NULL_HANDLE) and returns its bytes to the budget.
    void free(VkDeviceMemory memory, std::uint64_t bytes) const;
    void wait_idle() const;
    /// Blocks until the fence is signalled, in slices of finite time; throws VulkanError on device loss.
    void wait(VkFence fence, std::string_view object) const;
    /// Hands command buffers to the queue, to run in order; `fence` may be VK_NULL_HANDLE.
    void submit(std::span<const VkCommandBuffer> commands, VkFence fence, std::string_view object) const;
    /// Records with `record`, submits, waits: for set-up and tests, never in the frame loop.
    void run_once(const std::function<void(VkCommandBuffer)>& record) const;
    /// Returns the pipeline of a module and its constants. It is made when first asked for, which takes a
    /// driver 2 to 30 ms (docs/devices.md), and kept as long as the device, for every run on it. Throws as
    /// ComputePipeline does.
    const ComputePipeline& compute_pipeline(const std::string& module,
                                            std::span<const SpecializationConstant> constants = {}) const;
    /// Sets the name of VK_EXT_debug_utils, when validation is on.
    void set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

  private:
    struct Pipelines {
        std::mutex guard;
        std::map<std::string, std::unique_ptr<ComputePipeline>> made;  ///< by module and constants
    };
    struct Empty {};
    /// Holds nothing yet: once it returned, a throw in the delegating constructor runs the destructor.
    Device(const Instance& instance, DeviceInfo info, Empty);
    void read_capabilities(std::span<const std::string_view> without);
    void create();

    const Instance& instance_;
    DeviceInfo info_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDevice handle_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool once_pool_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    DeviceCapabilities capabilities_;
    PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
    mutable MemoryBudget budget_{0};
    mutable Pipelines pipelines_;
};

}  // namespace drape::vulkan
