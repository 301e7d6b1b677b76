// Finds the device that a selector names. It calls no Vulkan function, so tests cover machines that we do not have.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vulkan/instance.h"

namespace drape::vulkan {

/// Returns the device that `selector` names. Empty: the usable device of the best type (discrete, integrated, virtual,
/// cpu; the loader's order among equals). "cpu": the first usable CPU device. Digits: INDEX. Else a UUID (with or
/// without dashes), then NAME: the whole name, or a part of exactly one name, in any case. Throws VulkanError that
/// lists every device, and why it cannot be used, when nothing usable fits.
const DeviceInfo& select_device(std::span<const DeviceInfo> devices, std::string_view selector);

/// Returns one line per device, for error messages and `drape devices`.
std::string device_list_text(std::span<const DeviceInfo> devices);

}  // namespace drape::vulkan
