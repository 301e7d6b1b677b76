#pragma once

#include <string>
#include <string_view>

#include "drape/error.h"
#include "vulkan/api.h"

namespace drape::vulkan {

/// Thrown where a Vulkan call fails, a device does not fit or a budget is exceeded; the command line exits with code 4.
/// `what()` reads "vkCreateImage(banner/position): VK_ERROR_...".
class VulkanError : public DeviceError {
  public:
    VulkanError(VkResult result, std::string_view call, std::string_view object = {});
    /// Makes an error that is no VkResult: no such device, a missing feature, a budget exceeded, a shader mismatch.
    explicit VulkanError(const std::string& message);
    VkResult result() const { return result_; }
    bool is_failed_call() const { return is_failed_call_; }

  private:
    VkResult result_ = VK_ERROR_UNKNOWN;
    bool is_failed_call_ = false;
};

/// Throws VulkanError unless `result` is VK_SUCCESS.
void check(VkResult result, std::string_view call, std::string_view object = {});

/// Waits until the device runs nothing any more, for destructors, which cannot throw. A lost device runs nothing, and
/// if there is no memory for waiting, going on is the best choice.
void let_finish(VkDevice device) noexcept;

/// Returns "VK_ERROR_DEVICE_LOST" and so on.
std::string_view result_name(VkResult result);

}  // namespace drape::vulkan
