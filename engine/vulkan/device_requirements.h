// What Drape asks of a physical device, and what a device says of itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vulkan/instance.h"

namespace drape::vulkan {

/// Name, driver, UUID, and whether (and why not) the device can be used.
DeviceInfo describe_device(VkPhysicalDevice physical, std::uint32_t index);

/// First queue family with graphics and compute.
std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical);

}  // namespace drape::vulkan
