#include "vulkan/device_requirements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
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

/// Returns whether images of the format (optimal tiling) can be used so.
bool has_format(const DeviceFacts& facts, VkFormat format, VkFormatFeatureFlags features) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(facts.physical, format, &properties);
    return (properties.optimalTilingFeatures & features) == features;
}

using Facts = const DeviceFacts&;
constexpr std::uint32_t shadow_texels = 2048 * 2048;  // the largest texel buffer of every picture
bool has_large_texel_buffers(Facts f) { return f.properties.limits.maxTexelBufferElements >= shadow_texels; }

constexpr DeviceRequirement requirements[] = {
    {"synchronization2", "the feature synchronization2", "every barrier names its stages and accesses", "",
     [](Facts f) { return f.features13.synchronization2 == VK_TRUE; }},
    {"dynamic_rendering", "the feature dynamicRendering", "pictures are drawn without render passes", "",
     [](Facts f) { return f.features13.dynamicRendering == VK_TRUE; }},
    {"maintenance4", "the feature maintenance4", "workgroups are as large as constants say", "",
     [](Facts f) { return f.features13.maintenance4 == VK_TRUE; }},
    {"clip_distance", "the feature shaderClipDistance", "what is below the floor is not drawn", "",
     [](Facts f) { return f.features.shaderClipDistance == VK_TRUE; }},
    {"queue", "a queue family with graphics and compute", "one queue simulates and draws, in order", "",
     [](Facts f) { return f.queue_family.has_value(); }},
    {"vector_images", "R32G32B32A32_SFLOAT storage images", "the state of cloth", "",
     [](Facts f) { return has_format(f, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT); }},
    {"scalar_images", "R32_SFLOAT storage images", "tensions, the shadow map", "",
     [](Facts f) { return has_format(f, VK_FORMAT_R32_SFLOAT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT); }},
    {"depth", "D32_SFLOAT depth attachments", "pictures", "",
     [](Facts f) { return has_format(f, VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT); }},
    {"colour", "R8G8B8A8_SRGB colour attachments", "pictures", "",
     [](Facts f) { return has_format(f, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT); }},
    {"push_descriptors", "the extension VK_KHR_push_descriptor", "passes bind what they use when they are recorded",
     "sets from pools of the recorded plan", [](Facts f) { return f.max_push_descriptors > 0; }},
    {"texel_buffers", "texel buffers of 4,194,304 texels", "a CPU loads them four times as fast as storage buffers",
     "storage buffers in the same shaders", has_large_texel_buffers},
    {"storage_images", "15 storage images a stage", "the passes with most of them",
     "scenes that need such a pass are refused, with its name",
     [](Facts f) { return f.properties.limits.maxPerStageDescriptorStorageImages >= most_storage_images; }},
    {"storage_buffers", "12 storage buffers a stage, 15 without `texel_buffers`", "the passes with most of them",
     "scenes that need such a pass are refused, with its name",
     [](Facts f) {
         return f.properties.limits.maxPerStageDescriptorStorageBuffers >=
                (has_large_texel_buffers(f) ? most_storage_buffers : most_buffers_for_texels);
     }},
    {"wide_integers", "the feature shaderInt64", "sums of contact between cloth, the kernel buffer_store",
     "sums in pairs of 32 bits, stores to images", [](Facts f) { return f.features.shaderInt64 == VK_TRUE; }},
    {"wide_atomics", "the feature shaderBufferInt64Atomics", "contact between cloth sums in one atomic",
     "two atomics of 32 bits, and a carry",
     [](Facts f) { return f.features.shaderInt64 == VK_TRUE && f.features12.shaderBufferInt64Atomics == VK_TRUE; }},
    {"samples_in_shaders", "the feature shaderStorageImageMultisample, with 4 samples",
     "one pass encodes a picture of 4 samples", "a resolve before it",
     [](Facts f) {
         return f.features.shaderStorageImageMultisample == VK_TRUE &&
                (f.properties.limits.storageImageSampleCounts & VK_SAMPLE_COUNT_4_BIT) != 0;
     }},
    {"shuffles", "subgroups that shuffle in compute shaders", "kernels that keep neighbours in registers",
     "the plain kernels, or tiles", [](Facts f) { return f.shuffling_lanes() > 0; }},
    {"full_subgroups", "the feature computeFullSubgroups", "the kernel line_parts", "line_cyclic, or plain",
     [](Facts f) { return f.features13.computeFullSubgroups == VK_TRUE; }},
    {"shared_memory", "32 KiB of shared memory, 1,024 invocations a workgroup", "tiles of 32 x 32 particles",
     "smaller groups, or the plain kernels",
     [](Facts f) {
         return f.properties.limits.maxComputeSharedMemorySize >= 32768 &&
                f.properties.limits.maxComputeWorkGroupInvocations >= 1024;
     }},
    {"timestamps", "timestamps", "profiles and times of passes", "no times",
     [](Facts f) { return f.timestamp_valid_bits > 0; }},
};

/// Returns the first requirement that the device lacks; empty when it has them all.
std::string missing_requirement(const DeviceFacts& facts) {
    for (const DeviceRequirement& each : requirements)
        if (each.without.empty() && !each.has(facts)) return fmt::format("it has not {}", each.what);
    return {};
}

}  // namespace

const DeviceRequirement& optional_requirement(std::string_view key) {
    const auto found = std::ranges::find(requirements, key, &DeviceRequirement::key);
    if (found != std::end(requirements) && !found->without.empty()) return *found;
    throw VulkanError(fmt::format("'{}' is nothing that a device may lack", key));
}

DeviceFacts::DeviceFacts(VkPhysicalDevice device) : physical(device) {
    properties11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    properties13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    auto push = structure<VkPhysicalDevicePushDescriptorPropertiesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR);
    auto all = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    all.pNext = &properties11;
    properties11.pNext = &properties13;
    const bool pushes = has_extension(device, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    properties13.pNext = pushes ? &push : nullptr;
    vkGetPhysicalDeviceProperties2(device, &all);
    properties = all.properties;
    max_push_descriptors = push.maxPushDescriptors;
    properties11.pNext = properties13.pNext = nullptr;  // this object may be moved

    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    features12.pNext = &features13;
    auto all_features = structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    all_features.pNext = &features12;
    vkGetPhysicalDeviceFeatures2(device, &all_features);
    features = all_features.features;
    features12.pNext = nullptr;

    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t family = 0; family < count && !queue_family; ++family)
        if ((families[family].queueFlags & needed) == needed && families[family].queueCount > 0) {
            queue_family = family;
            timestamp_valid_bits = families[family].timestampValidBits;
        }
}

std::uint32_t DeviceFacts::shuffling_lanes() const {
    const bool shuffles = (properties11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) &&
                          (properties11.subgroupSupportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT);
    return shuffles ? properties11.subgroupSize : 0;
}

std::span<const DeviceRequirement> device_requirements() { return requirements; }

std::string device_requirements_document() {
    std::string text = "| name | what | for | without it |\n|---|---|---|---|\n";
    text += "| | Vulkan 1.3 | all | the device cannot be used |\n";
    for (const DeviceRequirement& each : requirements)
        text += fmt::format("| `{}` | {} | {} | {} |\n", each.key, each.what, each.why,
                            each.without.empty() ? "the device cannot be used" : each.without);
    return text;
}

std::vector<std::string> absent_requirements(const DeviceFacts& facts) {
    std::vector<std::string> keys;
    for (const DeviceRequirement& each : requirements)
        if (!each.without.empty() && !each.has(facts)) keys.emplace_back(each.key);
    const char* const variable = std::getenv("DRAPE_WITHOUT");
    std::string_view named = variable ? variable : "";
    while (!named.empty()) {
        const std::string_view key = named.substr(0, named.find(','));
        named.remove_prefix(std::min(named.size(), key.size() + 1));
        if (std::ranges::find(keys, optional_requirement(key).key) == keys.end()) keys.emplace_back(key);
    }
    return keys;
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
    // The version is checked first: what else is asked takes structures that an older device need not know.
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        info.unusable_reason = fmt::format("Vulkan 1.3 is needed, the device has {}", info.api_version);
    } else {
        const DeviceFacts facts(physical);
        info.unusable_reason = missing_requirement(facts);
        info.lacks = absent_requirements(facts);
    }
    info.usable = info.unusable_reason.empty();
    return info;
}

}  // namespace drape::vulkan
