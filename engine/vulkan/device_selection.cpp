#include "vulkan/device_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace drape::vulkan {

namespace {

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

std::string without_dashes(std::string_view text) {
    std::string plain = lower_case(text);
    std::erase(plain, '-');
    return plain;
}

/// Returns the rank of a device's type; a smaller rank is better.
std::size_t type_rank(const DeviceInfo& device) {
    constexpr std::array<std::string_view, 4> order = {"discrete", "integrated", "virtual", "cpu"};
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), device.type) - order.begin());
}

[[noreturn]] void refuse(const std::string& why, std::span<const DeviceInfo> devices) {
    throw VulkanError(fmt::format("{}; the devices are:\n{}", why, device_list_text(devices)));
}

const DeviceInfo* best_usable(std::span<const DeviceInfo> devices) {
    const DeviceInfo* best = nullptr;
    for (const DeviceInfo& device : devices) {
        if (device.usable && (!best || type_rank(device) < type_rank(*best))) best = &device;
    }
    return best;
}

const DeviceInfo& first_cpu(std::span<const DeviceInfo> devices) {
    for (const DeviceInfo& device : devices) {
        if (device.usable && device.type == "cpu") return device;
    }
    refuse("no usable CPU device", devices);
}

const DeviceInfo& by_index(std::span<const DeviceInfo> devices, std::string_view selector) {
    std::uint32_t index = 0;
    const auto [end, error] = std::from_chars(selector.data(), selector.data() + selector.size(), index);
    if (error == std::errc{} && end == selector.data() + selector.size()) {
        for (const DeviceInfo& device : devices) {
            if (device.index == index) return device;
        }
    }
    refuse(fmt::format("there is no device {}", selector), devices);
}

const DeviceInfo& by_uuid_or_name(std::span<const DeviceInfo> devices, std::string_view selector) {
    std::vector<const DeviceInfo*> same_uuid, same_name, name_contains;
    for (const DeviceInfo& device : devices) {
        const std::string name = lower_case(device.name), wanted = lower_case(selector);
        if (without_dashes(device.uuid_text()) == without_dashes(selector)) same_uuid.push_back(&device);
        if (name == wanted) same_name.push_back(&device);
        if (name.find(wanted) != std::string::npos) name_contains.push_back(&device);
    }
    for (const auto* matches : {&same_uuid, &same_name, &name_contains}) {
        if (matches->size() == 1) return *matches->front();
        if (matches->size() > 1) {
            refuse(
                fmt::format("device \"{}\" is ambiguous ({} devices match), use the index", selector, matches->size()),
                devices);
        }
    }
    refuse(fmt::format("no device matches \"{}\" (INDEX, NAME, UUID or cpu)", selector), devices);
}

}  // namespace

std::string device_list_text(std::span<const DeviceInfo> devices) {
    std::string text;
    for (const DeviceInfo& device : devices) {
        text += fmt::format("  {}: {} [{}, Vulkan {}, {} {}, UUID {}]{}{}\n", device.index, device.name, device.type,
                            device.api_version, device.driver, device.driver_version, device.uuid_text(),
                            device.usable ? "" : " cannot be used: ", device.unusable_reason);
    }
    if (!text.empty()) text.pop_back();
    return text;
}

const DeviceInfo& select_device(std::span<const DeviceInfo> devices, std::string_view selector) {
    if (devices.empty()) throw VulkanError("no Vulkan device found");
    if (selector.empty()) {
        if (const DeviceInfo* best = best_usable(devices)) return *best;
        refuse("no usable Vulkan device", devices);
    }
    if (selector == "cpu") return first_cpu(devices);
    const bool digits = std::all_of(selector.begin(), selector.end(), [](char c) { return c >= '0' && c <= '9'; });
    const DeviceInfo& chosen = digits ? by_index(devices, selector) : by_uuid_or_name(devices, selector);
    if (!chosen.usable) {
        refuse(fmt::format("device {} ({}) cannot be used: {}", chosen.index, chosen.name, chosen.unusable_reason),
               devices);
    }
    return chosen;
}

}  // namespace drape::vulkan
