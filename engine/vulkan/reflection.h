// What a SPIR-V module says of itself, read once with SPIRV-Cross, and its comparison with a declaration.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vulkan/shader_interface.h"

namespace drape::vulkan {

struct ReflectedMember {
    std::string name;
    std::uint32_t offset;  ///< bytes from the struct's start
};

struct ReflectedStruct {
    std::string name;
    std::uint32_t size = 0;  ///< bytes, without padding at the end
    std::vector<ReflectedMember> members;
};

/// A descriptor that the entry point statically uses.
struct ReflectedDescriptor {
    std::uint32_t set = 0, binding = 0;
    std::string name;                    ///< variable (image) or block (buffer)
    std::string kind_name;               ///< "storage image", "uniform buffer", ...
    std::optional<DescriptorKind> kind;  ///< none: a kind that Drape does not use
    bool is_array = false;               ///< of descriptors
    bool readable = true, writable = true;
    VkFormat format = VK_FORMAT_UNDEFINED;   ///< images
    bool is_runtime_array = false;           ///< buffers: the block is one runtime array and nothing else
    std::uint32_t stride = 0;                ///< of that array, bytes
    std::optional<ReflectedStruct> element;  ///< when that array's elements are structs
};

struct ReflectedModule {
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_ALL;
    std::vector<ReflectedDescriptor> descriptors;
    std::optional<ReflectedStruct> push_constants;
    std::vector<std::uint32_t> constant_ids;  ///< specialization constants
    std::array<std::uint32_t, 3> local_size{};
    std::array<std::optional<std::uint32_t>, 3> local_size_constant_ids;
};

/// Throws VulkanError naming `module` when SPIRV-Cross cannot read the words.
ReflectedModule reflect(std::span<const std::uint32_t> words, std::string_view module);

/// Throws VulkanError listing every difference; see check_interface.
void require_match(const ReflectedModule& module, const ShaderInterface& declared);

}  // namespace drape::vulkan
