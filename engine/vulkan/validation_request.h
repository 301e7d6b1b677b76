// How an instance asks for the validation layer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vulkan/api.h"

namespace drape::vulkan {

#ifndef VK_EXT_layer_settings
/// Headers before 1.3.272 lack this extension; the names and values are those of Vulkan's registry.
struct VkLayerSettingEXT {
    const char* pLayerName;
    const char* pSettingName;
    std::uint32_t type;
    std::uint32_t valueCount;
    const void* pValues;
};
struct VkLayerSettingsCreateInfoEXT {
    VkStructureType sType;
    const void* pNext;
    std::uint32_t settingCount;
    const VkLayerSettingEXT* pSettings;
};
#endif

/// Core and synchronization validation with a messenger, which sees the making of the instance too. It must outlive
/// vkCreateInstance, and stay where it is.
class ValidationRequest {
  public:
    /// Throws VulkanError without the layer.
    explicit ValidationRequest(const VkDebugUtilsMessengerCreateInfoEXT& messenger);
    ValidationRequest(const ValidationRequest&) = delete;
    void put_into(VkInstanceCreateInfo& info) const;

  private:
    VkDebugUtilsMessengerCreateInfoEXT messenger_;
    VkValidationFeaturesEXT features_{};
    std::array<VkLayerSettingEXT, 3> settings_{};
    VkLayerSettingsCreateInfoEXT layer_{};
    std::vector<const char*> extensions_;
};

}  // namespace drape::vulkan
