// Queries what a physical device is, and whether it has what Drape needs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vulkan/instance.h"

namespace drape::vulkan {

/// Returns name, driver, UUID, and whether (and why not) the device can be used.
DeviceInfo describe_device(VkPhysicalDevice physical, std::uint32_t index);

/// Returns the first queue family with graphics and compute.
std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical);

}  // namespace drape::vulkan
