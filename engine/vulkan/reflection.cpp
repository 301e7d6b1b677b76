#include "vulkan/reflection.h"

#include <fmt/format.h>
#include <spirv_cross_c.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

#include "spirv_modules.h"

namespace drape::vulkan {

namespace {

VkFormat image_format(SpvImageFormat format) {
    switch (format) {
        case SpvImageFormatRgba32f:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case SpvImageFormatRg32f:
            return VK_FORMAT_R32G32_SFLOAT;
        case SpvImageFormatR32f:
            return VK_FORMAT_R32_SFLOAT;
        case SpvImageFormatRgba16f:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case SpvImageFormatRgba8:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case SpvImageFormatR8:
            return VK_FORMAT_R8_UNORM;
        case SpvImageFormatR32i:
            return VK_FORMAT_R32_SINT;
        case SpvImageFormatRgba32ui:
            return VK_FORMAT_R32G32B32A32_UINT;
        case SpvImageFormatRg32ui:
            return VK_FORMAT_R32G32_UINT;
        case SpvImageFormatR32ui:
            return VK_FORMAT_R32_UINT;
        case SpvImageFormatRgba8ui:
            return VK_FORMAT_R8G8B8A8_UINT;
        case SpvImageFormatR8ui:
            return VK_FORMAT_R8_UINT;
        default:
            return VK_FORMAT_UNDEFINED;
    }
}

VkShaderStageFlagBits stage_of(SpvExecutionModel model) {
    switch (model) {
        case SpvExecutionModelVertex:
            return VK_SHADER_STAGE_VERTEX_BIT;
        case SpvExecutionModelFragment:
            return VK_SHADER_STAGE_FRAGMENT_BIT;
        case SpvExecutionModelGLCompute:
            return VK_SHADER_STAGE_COMPUTE_BIT;
        default:
            return VK_SHADER_STAGE_ALL;
    }
}

struct ResourceKind {
    spvc_resource_type type;
    std::string_view name;
    std::optional<DescriptorKind> kind;
};

/// Resources of these kinds have a set and a binding; those without a DescriptorKind are reported as mismatches.
constexpr ResourceKind resource_kinds[] = {
    {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, "storage image", DescriptorKind::storage_image},
    {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, "storage buffer", DescriptorKind::storage_buffer},
    {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, "uniform buffer", std::nullopt},
    {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, "combined image sampler", std::nullopt},
    {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, "sampled image", std::nullopt},
    {SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, "sampler", std::nullopt},
    {SPVC_RESOURCE_TYPE_SUBPASS_INPUT, "input attachment", std::nullopt},
    {SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, "acceleration structure", std::nullopt},
};

std::string stride_difference(std::uint32_t shader, std::uint32_t layout) {
    return shader == layout ? "" : fmt::format("the array's stride is {} in the shader, {} in C++", shader, layout);
}

std::string member_difference(const ReflectedStruct& shader, const glsl::StructLayout& layout) {
    if (shader.name != layout.name) return fmt::format("struct {} in the shader, {} in C++", shader.name, layout.name);
    if (shader.members.size() != layout.offsets.size())
        return fmt::format("{} has {} members in the shader, {} in C++", shader.name, shader.members.size(),
                           layout.offsets.size());
    for (std::size_t i = 0; i < layout.offsets.size(); ++i)
        if (shader.members[i].offset != layout.offsets[i])
            return fmt::format("the offset of {}.{} is {} in the shader, {} in C++", shader.name,
                               shader.members[i].name, shader.members[i].offset, layout.offsets[i]);
    return {};
}

class Reflector {
  public:
    Reflector(std::span<const std::uint32_t> words, std::string_view module) : module_(module) {
        spvc_context context = nullptr;
        if (spvc_context_create(&context) != SPVC_SUCCESS) fail("no memory");
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        require(spvc_context_parse_spirv(context, words.data(), words.size(), &ir));
        require(
            spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
    }

    ReflectedModule module() const {
        ReflectedModule result;
        result.stage = stage_of(spvc_compiler_get_execution_model(compiler_));
        spvc_set active = nullptr;
        spvc_resources resources = nullptr;
        require(spvc_compiler_get_active_interface_variables(compiler_, &active));
        require(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources, active));
        for (const ResourceKind& kind : resource_kinds) {
            for (const spvc_reflected_resource& resource : list(resources, kind.type)) {
                result.descriptors.push_back(descriptor(resource, kind));
                result.descriptors.back().stages = result.stage;
            }
        }
        for (const spvc_reflected_resource& resource : list(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
            result.push_constants = push_constants(resource.base_type_id);
        }
        const spvc_specialization_constant* constants = nullptr;
        std::size_t count = 0;
        require(spvc_compiler_get_specialization_constants(compiler_, &constants, &count));
        for (const auto& constant : std::span(constants, count)) {
            const std::string name = spvc_compiler_get_name(compiler_, constant.id);
            if (!name.empty()) result.constants.emplace(name, constant.constant_id);  // workgroup sizes have none
        }
        if (result.stage == VK_SHADER_STAGE_COMPUTE_BIT) read_local_size(result);
        if (result.stage == VK_SHADER_STAGE_VERTEX_BIT)
            result.varying_locations = locations(list(resources, SPVC_RESOURCE_TYPE_STAGE_OUTPUT));
        if (result.stage == VK_SHADER_STAGE_FRAGMENT_BIT)
            result.varying_locations = locations(list(resources, SPVC_RESOURCE_TYPE_STAGE_INPUT));
        return result;
    }

  private:
    [[noreturn]] void fail(std::string_view why) const {
        throw VulkanError(fmt::format("shader module {} cannot be read: {}", module_, why));
    }
    void require(spvc_result result) const {
        if (result != SPVC_SUCCESS) fail(spvc_context_get_last_error_string(context_.get()));
    }

    std::span<const spvc_reflected_resource> list(spvc_resources resources, spvc_resource_type type) const {
        const spvc_reflected_resource* first = nullptr;
        std::size_t count = 0;
        require(spvc_resources_get_resource_list_for_type(resources, type, &first, &count));
        return {first, count};
    }

    ReflectedDescriptor descriptor(const spvc_reflected_resource& resource, const ResourceKind& kind) const {
        ReflectedDescriptor result;
        result.set = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationDescriptorSet);
        result.binding = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationBinding);
        result.name = resource.name;
        result.kind_name = kind.name;
        result.kind = kind.kind;
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, resource.type_id);
        result.is_array = spvc_type_get_num_array_dimensions(type) > 0;
        if (kind.kind == DescriptorKind::storage_image) {
            if (spvc_type_get_image_dimension(type) == SpvDimBuffer) {
                result.kind_name = "storage texel buffer";
                result.kind = DescriptorKind::texel_buffer;
            }
            result.format = image_format(spvc_type_get_image_storage_format(type));
            result.readable = !spvc_compiler_has_decoration(compiler_, resource.id, SpvDecorationNonReadable);
            result.writable = !spvc_compiler_has_decoration(compiler_, resource.id, SpvDecorationNonWritable);
        } else if (kind.kind == DescriptorKind::storage_buffer) {
            read_block(resource, result);
        }
        return result;
    }

    void read_block(const spvc_reflected_resource& resource, ReflectedDescriptor& result) const {
        // For blocks, GLSL's qualifiers become decorations of the members; these are those that all members share.
        const SpvDecoration* decorations = nullptr;
        std::size_t count = 0;
        require(spvc_compiler_get_buffer_block_decorations(compiler_, resource.id, &decorations, &count));
        for (const SpvDecoration decoration : std::span(decorations, count)) {
            if (decoration == SpvDecorationNonReadable) result.readable = false;
            if (decoration == SpvDecorationNonWritable) result.writable = false;
        }
        const spvc_type block = spvc_compiler_get_type_handle(compiler_, resource.base_type_id);
        if (spvc_type_get_num_member_types(block) != 1) return;
        const spvc_type member = spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(block, 0));
        result.is_runtime_array = spvc_type_get_num_array_dimensions(member) == 1 &&
                                  spvc_type_array_dimension_is_literal(member, 0) &&
                                  spvc_type_get_array_dimension(member, 0) == 0;
        if (!result.is_runtime_array) return;
        result.name = spvc_compiler_get_member_name(compiler_, resource.base_type_id, 0);
        require(spvc_compiler_type_struct_member_array_stride(compiler_, block, 0, &result.stride));
        if (spvc_type_get_basetype(member) == SPVC_BASETYPE_STRUCT) {
            result.element = structure_of(spvc_type_get_base_type_id(member));
        }
    }

    ReflectedStruct structure_of(spvc_type_id id) const {
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, id);
        ReflectedStruct result;
        result.name = spvc_compiler_get_name(compiler_, id);
        std::size_t size = 0;
        require(spvc_compiler_get_declared_struct_size(compiler_, type, &size));
        result.size = static_cast<std::uint32_t>(size);
        for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
            unsigned offset = 0;
            require(spvc_compiler_type_struct_member_offset(compiler_, type, i, &offset));
            result.members.push_back({spvc_compiler_get_member_name(compiler_, id, i), offset});
        }
        return result;
    }

    ReflectedStruct push_constants(spvc_type_id id) const {
        const spvc_type block = spvc_compiler_get_type_handle(compiler_, id);
        if (spvc_type_get_num_member_types(block) == 1) {
            const spvc_type only = spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(block, 0));
            if (spvc_type_get_basetype(only) == SPVC_BASETYPE_STRUCT && spvc_type_get_num_array_dimensions(only) == 0) {
                return structure_of(spvc_type_get_base_type_id(only));
            }
        }
        return structure_of(id);
    }

    void read_local_size(ReflectedModule& result) const {
        spvc_specialization_constant constants[3] = {};
        spvc_compiler_get_work_group_size_specialization_constants(compiler_, &constants[0], &constants[1],
                                                                   &constants[2]);
        for (unsigned axis = 0; axis < 3; ++axis) {
            result.local_size[axis] =
                spvc_compiler_get_execution_mode_argument_by_index(compiler_, SpvExecutionModeLocalSize, axis);
            if (constants[axis].id != 0)
                result.constants[std::string(local_size_names[axis])] = constants[axis].constant_id;
        }
    }

    /// Returns the number of locations up to the last one that these variables take.
    std::uint32_t locations(std::span<const spvc_reflected_resource> resources) const {
        std::uint32_t end = 0;
        for (const spvc_reflected_resource& resource : resources)
            end = std::max(end, spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationLocation) +
                                    locations_of(resource.type_id));
        return end;
    }

    /// Returns the number of a variable's locations (Vulkan 1.3, 15.1.4, "Location Assignment"): one per vector of
    /// 32-bit numbers.
    std::uint32_t locations_of(spvc_type_id id) const {
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, id);
        std::uint32_t each = spvc_type_get_columns(type);
        if (spvc_type_get_basetype(type) == SPVC_BASETYPE_STRUCT) {
            each = 0;
            for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i)
                each += locations_of(spvc_type_get_member_type(type, i));
        }
        for (unsigned i = 0; i < spvc_type_get_num_array_dimensions(type); ++i)
            each *= spvc_type_get_array_dimension(type, i);
        return each;
    }

    struct Destroy {
        void operator()(spvc_context context) const { spvc_context_destroy(context); }
    };
    std::string_view module_;
    std::unique_ptr<spvc_context_s, Destroy> context_;
    spvc_compiler compiler_ = nullptr;  // belongs to the context
};

}  // namespace

ReflectedModule reflect(std::span<const std::uint32_t> words, std::string_view module) {
    return Reflector(words, module).module();
}

std::string element_difference(const ReflectedDescriptor& shader, const glsl::StructLayout& layout) {
    if (shader.element.has_value() == layout.offsets.empty())
        return fmt::format("{} in the shader, {} in C++",
                           shader.element ? "struct " + shader.element->name : "a scalar or vector", layout.name);
    const std::string stride = stride_difference(shader.stride, layout.size);
    return shader.element && stride.empty() ? member_difference(*shader.element, layout) : stride;
}

std::string push_constant_difference(const std::optional<ReflectedStruct>& shader, const glsl::StructLayout* layout) {
    if (!shader && !layout) return {};
    if (!shader) return fmt::format("{} in C++, but the shader has none", layout->name);
    if (!layout) return fmt::format("{} in the shader, none in C++", shader->name);
    if (layout->size < shader->size || layout->size > (shader->size + 15) / 16 * 16)
        return fmt::format("{} bytes in the shader, {} in C++", shader->size, layout->size);
    return member_difference(*shader, *layout);
}

std::span<const std::uint32_t> spirv_module(std::string_view name) {
    for (const SpirvModule& module : spirv_modules()) {
        if (module.name == name) return module.words;
    }
    throw VulkanError(fmt::format("there is no shader module \"{}\"", name));
}

const ReflectedModule& module_interface(const std::string& name) {
    static std::mutex guard;
    static std::map<std::string, ReflectedModule> modules;
    const std::scoped_lock lock(guard);
    const auto found = modules.find(name);
    return found != modules.end() ? found->second
                                  : modules.emplace(name, reflect(spirv_module(name), name)).first->second;
}

}  // namespace drape::vulkan
