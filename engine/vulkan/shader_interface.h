// What the C++ side believes of a shader, checked against the SPIR-V once, when a pipeline is made.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vulkan/error.h"

namespace drape::vulkan {

enum class DescriptorKind { storage_image, storage_buffer };
enum class DescriptorAccess { read, write, read_write };

/// A member of a struct shared by GLSL and C++ (shaders/shared): offsets in bytes from the struct's start.
struct MemberLayout {
    std::string_view name;
    std::uint32_t offset;
};

/// A shared struct: an element of a storage buffer's runtime array, or the push constant block (its members
/// directly, or a block whose only member is that struct).
struct StructLayout {
    std::string_view name;
    std::uint32_t size;
    std::span<const MemberLayout> members;
};

struct DescriptorDeclaration {
    std::uint32_t binding;
    std::string_view name;  ///< the GLSL variable (image) or block (buffer) name
    DescriptorKind kind;
    DescriptorAccess access;                ///< must equal the shader's readonly / writeonly qualifiers
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< images: must equal the layout format
    const StructLayout* element = nullptr;  ///< buffers: runtime array of this struct; null: plain scalars or vectors
    std::uint32_t stride = 0;               ///< buffers without element: array stride in bytes
};

struct ShaderInterface {
    std::string_view module;                             ///< name in spirv/, e.g. "spring.comp"
    std::span<const DescriptorDeclaration> descriptors;  ///< set 0; what the shader statically uses
    const StructLayout* push_constants = nullptr;
    std::span<const std::uint32_t> words = {};  ///< tests: this SPIR-V instead of the committed module
};

/// The committed SPIR-V of `name` ("spring.comp"); throws VulkanError when there is none.
std::span<const std::uint32_t> spirv_module(std::string_view name);
/// All module names, sorted.
std::vector<std::string_view> spirv_module_names();

/// Reflects `words` with SPIRV-Cross and compares every descriptor (set 0, binding, kind, access, format,
/// array stride, member names and offsets) and the push constants with the declaration, both ways: an
/// undeclared descriptor is an error too, and so is a declared one the shader does not have.
/// Throws VulkanError naming module, binding and both sides; lists all mismatches.
void check_interface(std::span<const std::uint32_t> words, const ShaderInterface& interface);

/// Workgroup size of a compute module by reflection (LocalSize), x y z; the default values where it is
/// specialised.
std::array<std::uint32_t, 3> local_size(std::span<const std::uint32_t> words);

}  // namespace drape::vulkan
