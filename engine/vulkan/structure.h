// Helpers for every Vulkan structure and every vkCreate call.
#pragma once

#include "vulkan/error.h"

namespace drape::vulkan {

template <class T>
T structure(VkStructureType type) {
    T value{};
    value.sType = type;
    return value;
}

/// Calls `function` (vkCreateX) and stores the handle only on success, since the output of a failed call is undefined
/// and must not reach a destructor. Throws VulkanError.
template <class Function, class Info, class Handle>
void create_handle(Function function, VkDevice device, const Info& info, Handle& handle, std::string_view call,
                   std::string_view object) {
    Handle made = VK_NULL_HANDLE;
    check(function(device, &info, nullptr, &made), call, object);
    handle = made;
}

}  // namespace drape::vulkan
