#include "vulkan/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "vulkan/api.h"
#include "vulkan/device_requirements.h"
#include "vulkan/structure.h"
#include "vulkan/validation_request.h"

namespace drape::vulkan {

/// The data for the messenger's callback, whose address is stable while the Instance lives.
struct Instance::Echo {
    ValidationLog* log;
    bool print;

    static VKAPI_ATTR VkBool32 VKAPI_CALL callback(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                   VkDebugUtilsMessageTypeFlagsEXT types,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user_data);
    VkDebugUtilsMessengerCreateInfoEXT create_info();
};

namespace {

/// Returns whether a message is the hint that copies and clears in GENERAL are slow. Real layout errors have the same
/// message id, so the type and the text decide.
bool is_general_layout_hint(VkDebugUtilsMessageTypeFlagsEXT types, std::string_view id, std::string_view text) {
    return types == VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT &&
           id == "UNASSIGNED-CoreValidation-DrawState-InvalidImageLayout" &&
           text.find("instead of GENERAL") != std::string_view::npos;
}

void load_loader() {
    // This is called once per process, since each volkInitialize opens the library again.
    static const VkResult result = volkInitialize();
    if (result != VK_SUCCESS)
        throw VulkanError(
            "no Vulkan loader found (libvulkan.so.1, in Debian's package libvulkan1; a driver that runs on any CPU: "
            "mesa-vulkan-drivers)");
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3) {
        throw VulkanError("the Vulkan loader is older than 1.3");
    }
}

}  // namespace

VKAPI_ATTR VkBool32 VKAPI_CALL Instance::Echo::callback(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                        VkDebugUtilsMessageTypeFlagsEXT types,
                                                        const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                        void* user_data) {
    const Echo& echo = *static_cast<Echo*>(user_data);
    const std::string id = data->pMessageIdName ? data->pMessageIdName : "";
    const std::string text = data->pMessage ? data->pMessage : "";
    if (is_general_layout_hint(types, id, text)) return VK_FALSE;
    if (echo.print) std::fprintf(stderr, "validation: %s\n", text.c_str());
    echo.log->add(id, text);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT Instance::Echo::create_info() {
    auto info = structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // GENERAL messages are left out, since they are the loader's remarks on drivers for absent hardware.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = callback;
    info.pUserData = this;
    return info;
}

void ValidationLog::add(std::string message_id, std::string text) {
    ++count_;
    const std::lock_guard lock(mutex_);
    if (messages_.size() >= kept_message_count) return;
    // Most messages of the layer already contain their id.
    if (text.find(message_id) == std::string::npos) text = std::move(message_id) + ": " + text;
    messages_.push_back(std::move(text));
}

std::vector<std::string> ValidationLog::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

void ValidationLog::clear() {
    const std::lock_guard lock(mutex_);
    messages_.clear();
    count_ = 0;
}

Instance::Instance(const InstanceOptions& options, Empty)
    : validation_(options.validation),
      log_(std::make_unique<ValidationLog>()),
      echo_(std::make_unique<Echo>(Echo{log_.get(), options.print_messages})) {}

Instance::Instance(const InstanceOptions& options) : Instance(options, Empty{}) {
    load_loader();
    create(validation_);
    // These function pointers of the loader's own dispatch work for every instance and device of the process, with and
    // without layers. volkLoadDevice would bind them to one device, to save a jump per call.
    volkLoadInstance(handle_);
    if (validation_) {
        const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(handle_, "vkCreateDebugUtilsMessengerEXT"));
        const VkDebugUtilsMessengerCreateInfoEXT info = echo_->create_info();
        check(create_messenger(handle_, &info, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
    }
    list_devices();
}

void Instance::create(bool validation) {
    auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "drape";
    application.apiVersion = VK_API_VERSION_1_3;
    auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;

    std::optional<ValidationRequest> request;
    if (validation) request.emplace(echo_->create_info()).put_into(info);
    const VkResult result = vkCreateInstance(&info, nullptr, &handle_);
    if (result != VK_SUCCESS) handle_ = VK_NULL_HANDLE;
    check(result, "vkCreateInstance",
          result == VK_ERROR_INCOMPATIBLE_DRIVER ? "no Vulkan driver found" : std::string_view{});
}

void Instance::list_devices() {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(handle_, &count, nullptr), "vkEnumeratePhysicalDevices");
    physical_devices_.resize(count);
    check(vkEnumeratePhysicalDevices(handle_, &count, physical_devices_.data()), "vkEnumeratePhysicalDevices");
    physical_devices_.resize(count);
    for (std::uint32_t index = 0; index < count; ++index) {
        devices_.push_back(describe_device(physical_devices_[index], index));
    }
}

Instance::~Instance() {
    if (!handle_) return;
    if (messenger_) {
        // volk's own pointer belongs to the instance created last, which may lack the extension.
        const auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy_messenger(handle_, messenger_, nullptr);
    }
    vkDestroyInstance(handle_, nullptr);
}

}  // namespace drape::vulkan

std::string drape::DeviceInfo::uuid_text() const {
    std::string text;
    for (std::size_t i = 0; i < uuid.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += fmt::format("{:02x}", uuid[i]);
    }
    return text;
}
