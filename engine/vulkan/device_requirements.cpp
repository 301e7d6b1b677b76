#include "vulkan/device_requirements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "vulkan/api.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string_view type_name(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        default:
            return "other";
    }
}

bool has_extension(VkPhysicalDevice physical, const char* name) {
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr),
          "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data()),
          "vkEnumerateDeviceExtensionProperties");
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

/// Returns the first needed feature that is missing; empty when all are there.
std::string missing_feature(VkPhysicalDevice physical) {
    auto features13 =
        structure<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    auto features = structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    features.pNext = &features13;
    vkGetPhysicalDeviceFeatures2(physical, &features);
    if (!features13.synchronization2) return "the feature synchronization2 is missing";
    if (!features13.dynamicRendering) return "the feature dynamicRendering is missing";
    if (!features13.maintenance4) return "the feature maintenance4 is missing";
    if (!features.features.shaderClipDistance) return "the feature shaderClipDistance is missing";
    return {};
}

/// Returns the first needed format that cannot be used as needed (optimal tiling); empty when all can.
std::string missing_format(VkPhysicalDevice physical) {
    struct Need {
        VkFormat format;
        VkFormatFeatureFlags features;
        std::string_view text;
    };
    constexpr Need needs[] = {
        {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "R32G32B32A32_SFLOAT storage images"},
        {VK_FORMAT_R32_SFLOAT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "R32_SFLOAT storage images"},
        {VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "D32_SFLOAT depth attachments"},
        {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "R8G8B8A8_SRGB colour attachments"},
    };
    for (const Need& need : needs) {
        VkFormatProperties properties;
        vkGetPhysicalDeviceFormatProperties(physical, need.format, &properties);
        if ((properties.optimalTilingFeatures & need.features) != need.features) {
            return fmt::format("{} are missing", need.text);
        }
    }
    return {};
}

/// Returns the first requirement that the device lacks; empty when it has them all.
std::string missing_requirement(VkPhysicalDevice physical, std::uint32_t api_version) {
    // The version is checked first: the later queries use structures that an older device need not know.
    if (api_version < VK_API_VERSION_1_3) {
        return fmt::format("Vulkan 1.3 is needed, the device has {}", version_text(api_version));
    }
    if (std::string feature = missing_feature(physical); !feature.empty()) return feature;
    if (!has_extension(physical, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME)) {
        return "the extension VK_KHR_push_descriptor is missing";
    }
    if (!find_queue_family(physical)) return "no queue family has both graphics and compute";
    return missing_format(physical);
}

}  // namespace

std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t family = 0; family < count; ++family) {
        if ((families[family].queueFlags & needed) == needed && families[family].queueCount > 0) return family;
    }
    return std::nullopt;
}

DeviceInfo describe_device(VkPhysicalDevice physical, std::uint32_t index) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    DeviceInfo info;
    info.index = index;
    info.name = properties.deviceName;
    info.type = type_name(properties.deviceType);
    info.api_version = version_text(properties.apiVersion);
    info.driver_version = version_text(properties.driverVersion);
    if (properties.apiVersion >= VK_API_VERSION_1_2) {
        auto driver = structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
        auto id = structure<VkPhysicalDeviceIDProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES);
        id.pNext = &driver;
        auto all = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
        all.pNext = &id;
        vkGetPhysicalDeviceProperties2(physical, &all);
        info.driver = driver.driverName;
        // The text a vendor gives ("Mesa 22.3.6") says more than the packed number, whose packing is theirs.
        if (driver.driverInfo[0] != '\0') info.driver_version = driver.driverInfo;
        std::copy(std::begin(id.deviceUUID), std::end(id.deviceUUID), info.uuid.begin());
    }
    info.unusable_reason = missing_requirement(physical, properties.apiVersion);
    info.usable = info.unusable_reason.empty();
    return info;
}

}  // namespace drape::vulkan
