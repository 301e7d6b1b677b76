#pragma once

#include <string>

#include "vulkan/error.h"

namespace drape::test {

/// Returns the text of the VulkanError that `function` throws.
template <class Function>
std::string error_of(Function function) {
    try {
        function();
    } catch (const vulkan::VulkanError& error) {
        return error.what();
    }
    return "no VulkanError";
}

}  // namespace drape::test
