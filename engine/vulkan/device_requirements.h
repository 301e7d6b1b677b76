// What Drape asks of a device: one table, from which the check, its messages, `drape devices` and docs/devices.md
// follow.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/instance.h"

namespace drape::vulkan {

/// The device answers these questions once.
struct DeviceFacts {
    explicit DeviceFacts(VkPhysicalDevice device);

    VkPhysicalDevice physical;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceVulkan11Properties properties11{};
    VkPhysicalDeviceVulkan13Properties properties13{};
    std::uint32_t max_push_descriptors = 0;  ///< 0: none can be pushed
    VkPhysicalDeviceFeatures features{};
    VkPhysicalDeviceVulkan12Features features12{};
    VkPhysicalDeviceVulkan13Features features13{};
    std::optional<std::uint32_t> queue_family;  ///< the first with graphics and compute
    std::uint32_t timestamp_valid_bits = 0;     ///< of that family
    /// The invocations of a subgroup that compute shaders can shuffle in; 0 where they cannot.
    std::uint32_t shuffling_lanes() const;
};

struct DeviceRequirement {
    std::string_view key;   ///< "push_descriptors"
    std::string_view what;  ///< "the extension VK_KHR_push_descriptor"
    std::string_view why;
    std::string_view without;  ///< what is done on a device that lacks it; empty: the device cannot be used
    bool (*has)(const DeviceFacts&);
};

std::span<const DeviceRequirement> device_requirements();
/// Throws VulkanError where no row that may be lacking has that name.
const DeviceRequirement& optional_requirement(std::string_view key);

/// Returns the table as Markdown.
std::string device_requirements_document();

/// Returns the keys of the rows that the device is used without: what it lacks, and what the environment variable
/// DRAPE_WITHOUT names (keys, separated by commas), for tests of what is done there. Throws VulkanError where that
/// names no optional row.
std::vector<std::string> absent_requirements(const DeviceFacts& facts);

/// Returns name, driver, UUID, and whether (and why not) the device can be used.
DeviceInfo describe_device(VkPhysicalDevice physical, std::uint32_t index);

/// Counts of descriptors per stage that some pipeline has; texel buffers count as images or, in their place, as
/// buffers.
inline constexpr std::uint32_t most_storage_images = 15, most_storage_buffers = 12, most_buffers_for_texels = 15;

}  // namespace drape::vulkan
