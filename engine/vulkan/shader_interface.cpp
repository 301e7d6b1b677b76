#include "vulkan/shader_interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "spirv_modules.h"
#include "vulkan/reflection.h"

namespace drape::vulkan {

namespace {

std::string_view kind_name(DescriptorKind kind) {
    return kind == DescriptorKind::storage_image ? "storage image" : "storage buffer";
}

std::string_view access_name(DescriptorAccess access) {
    switch (access) {
        case DescriptorAccess::read:
            return "readonly";
        case DescriptorAccess::write:
            return "writeonly";
        case DescriptorAccess::read_write:
            return "read and write";
    }
    return "?";
}

std::string_view access_name(bool readable, bool writable) {
    if (!readable && !writable) return "readonly and writeonly";
    return access_name(!writable   ? DescriptorAccess::read
                       : !readable ? DescriptorAccess::write
                                   : DescriptorAccess::read_write);
}

/// In GLSL's words, since that is where the reader will look.
std::string format_name(VkFormat format) {
    switch (format) {
        case VK_FORMAT_UNDEFINED:
            return "none";
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return "rgba32f";
        case VK_FORMAT_R32G32_SFLOAT:
            return "rg32f";
        case VK_FORMAT_R32_SFLOAT:
            return "r32f";
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return "rgba16f";
        case VK_FORMAT_R8G8B8A8_UNORM:
            return "rgba8";
        case VK_FORMAT_R8_UNORM:
            return "r8";
        case VK_FORMAT_R32_SINT:
            return "r32i";
        case VK_FORMAT_R32G32B32A32_UINT:
            return "rgba32ui";
        case VK_FORMAT_R32G32_UINT:
            return "rg32ui";
        case VK_FORMAT_R32_UINT:
            return "r32ui";
        case VK_FORMAT_R8G8B8A8_UINT:
            return "rgba8ui";
        case VK_FORMAT_R8_UINT:
            return "r8ui";
        default:
            return fmt::format("VkFormat {}", static_cast<int>(format));
    }
}

/// Collects the differences between one module and its declaration.
class Comparison {
  public:
    explicit Comparison(std::string_view module) : module_(module) {}

    void descriptors(const std::vector<ReflectedDescriptor>& shader, std::span<const DescriptorDeclaration> declared) {
        std::set<std::uint32_t> bindings;
        for (const DescriptorDeclaration& declaration : declared) {
            where_ = fmt::format("binding {} ({})", declaration.binding, declaration.name);
            if (!bindings.insert(declaration.binding).second) add("is declared twice");
            const auto match = std::find_if(shader.begin(), shader.end(), [&](const auto& descriptor) {
                return descriptor.set == 0 && descriptor.binding == declaration.binding;
            });
            if (match == shader.end()) {
                add(fmt::format("is declared as a {}, but the shader does not use it", kind_name(declaration.kind)));
            } else {
                descriptor(*match, declaration);
            }
        }
        for (const ReflectedDescriptor& descriptor : shader) {
            where_ = fmt::format("binding {} ({})", descriptor.binding, descriptor.name);
            if (descriptor.set != 0) {
                add(fmt::format("is in set {}; only set 0 is used", descriptor.set));
            } else if (!bindings.contains(descriptor.binding)) {
                add(fmt::format("is used by the shader as a {}, but not declared", descriptor.kind_name));
            }
        }
    }

    void push_constants(const std::optional<ReflectedStruct>& shader, const StructLayout* declared) {
        where_ = "push constants";
        if (!shader && !declared) return;
        if (!shader) return add(fmt::format("are declared ({}), but the shader has none", declared->name));
        if (!declared) return add(fmt::format("are in the shader ({}), but not declared", shader->name));
        // C++ rounds a struct's size up to its alignment, which is at most 16 bytes.
        const std::uint32_t rounded = (shader->size + 15) / 16 * 16;
        if (declared->size < shader->size || declared->size > rounded) {
            differ("size of " + std::string(declared->name), shader->size, declared->size);
        }
        members(shader->members, *declared);
    }

    void finish() const {
        if (differences_.empty()) return;
        throw VulkanError(fmt::format("shader module {} differs from its declaration:{}", module_, differences_));
    }

  private:
    void add(const std::string& difference) { differences_ += fmt::format("\n  {} {}", where_, difference); }
    template <class Shader, class Declared>
    void differ(std::string_view what, const Shader& shader, const Declared& declared) {
        add(fmt::format("{}: the shader has {}, declared is {}", what, shader, declared));
    }

    void descriptor(const ReflectedDescriptor& shader, const DescriptorDeclaration& declared) {
        if (shader.name != declared.name) differ("name", shader.name, declared.name);
        if (shader.is_array) add("is an array of descriptors; only single ones are used");
        if (shader.kind != declared.kind) return differ("kind", shader.kind_name, kind_name(declared.kind));
        const bool readable = declared.access != DescriptorAccess::write;
        const bool writable = declared.access != DescriptorAccess::read;
        if (shader.readable != readable || shader.writable != writable) {
            differ("access", access_name(shader.readable, shader.writable), access_name(declared.access));
        }
        if (declared.kind == DescriptorKind::storage_buffer) return buffer(shader, declared);
        if (shader.format != declared.format) {
            differ("format", format_name(shader.format), format_name(declared.format));
        }
    }

    void buffer(const ReflectedDescriptor& shader, const DescriptorDeclaration& declared) {
        if (!shader.is_runtime_array) return add("is no block of one runtime array");
        if (shader.element && !declared.element) {
            return differ("element", "struct " + shader.element->name, "a scalar or vector");
        }
        if (!shader.element && declared.element) {
            return differ("element", "a scalar or vector", "struct " + std::string(declared.element->name));
        }
        const std::uint32_t stride = declared.element ? declared.element->size : declared.stride;
        if (shader.stride != stride) differ("array stride", shader.stride, stride);
        if (shader.element) members(shader.element->members, *declared.element);
    }

    void members(const std::vector<ReflectedMember>& shader, const StructLayout& declared) {
        for (const MemberLayout& member : declared.members) {
            const auto match = std::find_if(shader.begin(), shader.end(),
                                            [&](const auto& other) { return other.name == member.name; });
            const std::string name = fmt::format("member {}.{}", declared.name, member.name);
            if (match == shader.end()) {
                add(name + ": is declared, but the shader does not have it");
            } else if (match->offset != member.offset) {
                differ("offset of " + name, match->offset, member.offset);
            }
        }
        for (const ReflectedMember& member : shader) {
            const bool known = std::any_of(declared.members.begin(), declared.members.end(),
                                           [&](const auto& other) { return other.name == member.name; });
            if (!known) {
                add(fmt::format("member {}.{}: is in the shader, but not declared", declared.name, member.name));
            }
        }
    }

    std::string_view module_;
    std::string where_;
    std::string differences_;
};

}  // namespace

std::span<const std::uint32_t> spirv_module(std::string_view name) {
    for (const SpirvModule& module : spirv_modules()) {
        if (module.name == name) return module.words;
    }
    throw VulkanError(fmt::format("there is no shader module \"{}\"", name));
}

std::vector<std::string_view> spirv_module_names() {
    std::vector<std::string_view> names;
    for (const SpirvModule& module : spirv_modules()) names.push_back(module.name);
    std::sort(names.begin(), names.end());
    return names;
}

void require_match(const ReflectedModule& module, const ShaderInterface& declared) {
    Comparison comparison(declared.module);
    comparison.descriptors(module.descriptors, declared.descriptors);
    comparison.push_constants(module.push_constants, declared.push_constants);
    comparison.finish();
}

void check_interface(std::span<const std::uint32_t> words, const ShaderInterface& interface) {
    require_match(reflect(words, interface.module), interface);
}

std::array<std::uint32_t, 3> local_size(std::span<const std::uint32_t> words) {
    const ReflectedModule module = reflect(words, "(compute)");
    if (module.stage != VK_SHADER_STAGE_COMPUTE_BIT) {
        throw VulkanError("a shader module that is no compute shader has no workgroup size");
    }
    return module.local_size;
}

}  // namespace drape::vulkan
