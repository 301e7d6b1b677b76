#include "vulkan/validation_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* layer_settings = "VK_EXT_layer_settings";

void require_layer() {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    const bool found = std::ranges::any_of(
        layers, [](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, validation_layer) == 0; });
    if (!found)
        throw VulkanError(fmt::format("validation was asked for, but the layer {} is not installed", validation_layer));
}

bool layer_has(const char* extension) {
    std::uint32_t count = 0;
    const char* const call = "vkEnumerateInstanceExtensionProperties";
    check(vkEnumerateInstanceExtensionProperties(validation_layer, &count, nullptr), call);
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateInstanceExtensionProperties(validation_layer, &count, extensions.data()), call);
    return std::ranges::any_of(
        extensions, [&](const VkExtensionProperties& each) { return std::strcmp(each.extensionName, extension) == 0; });
}

/// Core validation is on by default; synchronization validation, which finds missing barriers, is not.
constexpr VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
constexpr VkBool32 yes = VK_TRUE, no = VK_FALSE;

VkLayerSettingEXT setting(const char* name, const VkBool32& value) {
    VkLayerSettingEXT made{};
    made.pLayerName = validation_layer;
    made.pSettingName = name;
    made.type = decltype(made.type){};  // VK_LAYER_SETTING_TYPE_BOOL32_EXT
    made.valueCount = 1;
    made.pValues = &value;
    return made;
}

}  // namespace

ValidationRequest::ValidationRequest(const VkDebugUtilsMessengerCreateInfoEXT& messenger)
    : messenger_(messenger), extensions_{VK_EXT_DEBUG_UTILS_EXTENSION_NAME} {
    require_layer();
    // Newer layers take settings; the features that came before them do not say enough.
    if (layer_has(layer_settings)) {
        // Since 1.3.290 what shaders access is left out without the heuristic, which is most of what there is here. A
        // message that is muted after its tenth time would hide later hazards.
        settings_ = {setting("validate_sync", yes), setting("syncval_shader_accesses_heuristic", yes),
                     setting("enable_message_limit", no)};
        layer_ = structure<VkLayerSettingsCreateInfoEXT>(static_cast<VkStructureType>(1000496000));
        layer_.settingCount = static_cast<std::uint32_t>(settings_.size());
        layer_.pSettings = settings_.data();
        messenger_.pNext = &layer_;
        extensions_.push_back(layer_settings);
        return;
    }
    features_ = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features_.enabledValidationFeatureCount = 1;
    features_.pEnabledValidationFeatures = enabled;
    messenger_.pNext = &features_;
    extensions_.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
}

void ValidationRequest::put_into(VkInstanceCreateInfo& info) const {
    info.pNext = &messenger_;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions_.size());
    info.ppEnabledExtensionNames = extensions_.data();
}

}  // namespace drape::vulkan
