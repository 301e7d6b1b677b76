// SPIRV-Cross reads once what a SPIR-V module declares: descriptors and push constants by their names in GLSL, so that
// C++ binds by name and no binding's number is repeated.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/struct_layout.h"
#include "vulkan/error.h"

namespace drape::vulkan {

enum class DescriptorKind { storage_image, storage_buffer, texel_buffer };

struct ReflectedMember {
    std::string name;
    std::uint32_t offset;  ///< bytes from the struct's start
    bool operator==(const ReflectedMember&) const = default;
};

struct ReflectedStruct {
    std::string name;
    std::uint32_t size = 0;  ///< bytes, without padding at the end
    std::vector<ReflectedMember> members;
    bool operator==(const ReflectedStruct&) const = default;
};

/// A descriptor that the entry point statically uses.
struct ReflectedDescriptor {
    std::uint32_t set = 0, binding = 0;
    std::string name;                    ///< the variable in GLSL: an image, or a buffer's runtime array
    std::string kind_name;               ///< "storage image", "uniform buffer", ...
    std::optional<DescriptorKind> kind;  ///< none: a kind that Drape does not use
    bool is_array = false;               ///< the variable is an array of descriptors
    bool readable = true, writable = true;
    VkFormat format = VK_FORMAT_UNDEFINED;   ///< images, texel buffers
    bool is_runtime_array = false;           ///< buffers: the block is one runtime array and nothing else
    std::uint32_t stride = 0;                ///< bytes from one element of that array to the next
    std::optional<ReflectedStruct> element;  ///< set when that array's elements are structs
    VkShaderStageFlags stages = 0;           ///< the stages that use it
    bool operator==(const ReflectedDescriptor&) const = default;
};

/// The names of the constants by which a workgroup's size is given (local_size_x_id, ...).
inline constexpr std::array<std::string_view, 3> local_size_names = {"local_size_x", "local_size_y", "local_size_z"};

/// A shader with this constant needs full subgroups, and receives in it how many invocations they have.
inline constexpr std::string_view subgroup_constant = "subgroup_lanes";

struct ReflectedModule {
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_ALL;
    std::vector<ReflectedDescriptor> descriptors;
    /// The push constant block, or the struct that is its only member.
    std::optional<ReflectedStruct> push_constants;
    /// Specialization constants, name -> id; those of the workgroup's size have the names local_size_names.
    std::map<std::string, std::uint32_t, std::less<>> constants;
    std::array<std::uint32_t, 3> local_size{};  ///< before specialisation
    /// The number of locations, of four components each, up to the last one that goes from vertices to fragments.
    std::uint32_t varying_locations = 0;
};

/// Throws VulkanError naming `module` when SPIRV-Cross cannot read the words.
ReflectedModule reflect(std::span<const std::uint32_t> words, std::string_view module);

/// Returns how the C++ struct differs from the shader's; empty when it does not. `shader` none: a scalar or a vector.
std::string element_difference(const ReflectedDescriptor& shader, const glsl::StructLayout& layout);
/// Returns the same for push constants, whose size C++ may round up to 16 bytes.
std::string push_constant_difference(const std::optional<ReflectedStruct>& shader, const glsl::StructLayout* layout);

/// Returns the SPIR-V of a shader ("spring.comp"); throws VulkanError when there is none.
std::span<const std::uint32_t> spirv_module(std::string_view name);

/// Returns what the module with this name declares, independent of its constants' values; it is read once. Throws as
/// `reflect` and `spirv_module` do.
const ReflectedModule& module_interface(const std::string& name);

}  // namespace drape::vulkan
