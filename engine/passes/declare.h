// Short spellings for the tables that say what a shader binds.
#pragma once

#include "vulkan/shader_interface.h"

namespace drape {

constexpr vulkan::DescriptorDeclaration image_read(std::uint32_t binding, std::string_view name,
                                                   VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT) {
    return {binding, name, vulkan::DescriptorKind::storage_image, vulkan::DescriptorAccess::read, format};
}

constexpr vulkan::DescriptorDeclaration image_write(std::uint32_t binding, std::string_view name,
                                                    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT) {
    return {binding, name, vulkan::DescriptorKind::storage_image, vulkan::DescriptorAccess::write, format};
}

constexpr vulkan::DescriptorDeclaration struct_buffer_read(std::uint32_t binding, std::string_view name,
                                                           const vulkan::StructLayout* element) {
    return {binding, name, vulkan::DescriptorKind::storage_buffer, vulkan::DescriptorAccess::read, VK_FORMAT_UNDEFINED,
            element, 0};
}

constexpr vulkan::DescriptorDeclaration vector_buffer_read(std::uint32_t binding, std::string_view name,
                                                           std::uint32_t stride) {
    return {binding, name,  vulkan::DescriptorKind::storage_buffer, vulkan::DescriptorAccess::read, VK_FORMAT_UNDEFINED,
            nullptr, stride};
}

}  // namespace drape
