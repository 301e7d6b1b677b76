// A Vulkan call that failed, a device that does not fit, a budget that is exceeded: always on, call named.
#pragma once

#include <string>
#include <string_view>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

#include "drape/error.h"

namespace drape::vulkan {

/// Exit code 4 of the command line. `what()` reads "vkCreateImage(banner/position): VK_ERROR_...".
class VulkanError : public DeviceError {
  public:
    VulkanError(VkResult result, std::string_view call, std::string_view object = {});
    /// A failure that is no VkResult: no such device, missing feature, over budget, shader mismatch.
    explicit VulkanError(const std::string& message);
    VkResult result() const { return result_; }

  private:
    VkResult result_ = VK_ERROR_UNKNOWN;
};

/// Throws VulkanError unless `result` is VK_SUCCESS.
void check(VkResult result, std::string_view call, std::string_view object = {});

/// "VK_ERROR_DEVICE_LOST" and so on.
std::string_view result_name(VkResult result);

}  // namespace drape::vulkan
