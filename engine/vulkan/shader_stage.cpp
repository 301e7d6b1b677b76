#include "vulkan/shader_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "vulkan/api.h"
#include "vulkan/structure.h"
#include "vulkan/texel_storage.h"

namespace drape::vulkan {

namespace {

std::string_view stage_name(VkShaderStageFlagBits stage) {
    switch (stage) {
        case VK_SHADER_STAGE_VERTEX_BIT:
            return "vertex";
        case VK_SHADER_STAGE_FRAGMENT_BIT:
            return "fragment";
        case VK_SHADER_STAGE_COMPUTE_BIT:
            return "compute";
        default:
            return "other";
    }
}

/// Throws a VulkanError that lists everything in the module that Drape does not use.
void require_known(const std::string& pipeline, const std::string& module, const ReflectedModule& reflected) {
    std::string unknown;
    for (const ReflectedDescriptor& descriptor : reflected.descriptors) {
        const auto add = [&](std::string_view what) {
            unknown += fmt::format("\n  '{}' (binding {}) {}", descriptor.name, descriptor.binding, what);
        };
        if (descriptor.set != 0) add(fmt::format("is in set {}; only set 0 is used", descriptor.set));
        if (!descriptor.kind) add(fmt::format("is a {}", descriptor.kind_name));
        if (descriptor.is_array) add("is an array of descriptors; only single ones are used");
        if (descriptor.kind == DescriptorKind::storage_buffer && !descriptor.is_runtime_array)
            add("is no block of one runtime array");
        if (descriptor.kind && descriptor.kind != DescriptorKind::storage_buffer &&
            descriptor.format == VK_FORMAT_UNDEFINED)
            add("has no format, or one that is not used");
        if (!descriptor.readable && !descriptor.writable) add("is neither read nor written");
    }
    if (!unknown.empty())
        throw VulkanError(
            fmt::format("pipeline {}: shader module {} has what is not used here:{}", pipeline, module, unknown));
}

void require_local_size(const VkPhysicalDeviceLimits& limits, const std::string& pipeline,
                        const std::array<std::uint32_t, 3>& size) {
    bool fits = std::uint64_t{size[0]} * size[1] * size[2] <= limits.maxComputeWorkGroupInvocations;
    for (std::size_t axis = 0; axis < size.size(); ++axis)
        fits = fits && size[axis] > 0 && size[axis] <= limits.maxComputeWorkGroupSize[axis];
    if (!fits)
        throw VulkanError(fmt::format("pipeline {}: the device cannot have workgroups of {} x {} x {}", pipeline,
                                      size[0], size[1], size[2]));
}

/// Throws if too many components go from vertices to fragments: Vulkan guarantees 64, and surfaces use more.
void require_varyings(const VkPhysicalDeviceLimits& limits, const std::string& pipeline, const std::string& module,
                      std::uint32_t locations) {
    const std::uint32_t most = std::min(limits.maxVertexOutputComponents, limits.maxFragmentInputComponents);
    if (4 * locations > most)
        throw VulkanError(fmt::format("pipeline {}: {} takes {} components from vertices to fragments, the device {}",
                                      pipeline, module, 4 * locations, most));
}

}  // namespace

ShaderStage::ShaderStage(const Device& device, const std::string& pipeline, const Shader& shader,
                         VkShaderStageFlagBits stage, std::span<const SpecializationConstant> constants)
    : device_(device), name_(shader.module) {
    const bool is_committed = shader.words.empty();
    constants_ = is_committed ? module_interface(name_).constants : reflect(shader.words, name_).constants;
    const SpecialisedModule specialised =
        is_committed ? specialised_module(name_, constants) : specialise(shader.words, name_, constants);
    reflected_ = specialised.reflected;
    if (reflected_.stage != stage) {
        throw VulkanError(fmt::format("pipeline {}: shader module {} is a {} shader, not a {} shader", pipeline, name_,
                                      stage_name(reflected_.stage), stage_name(stage)));
    }
    require_known(pipeline, name_, reflected_);
    // A module beyond the limits is itself wrong, as newer validation layers say.
    if (stage == VK_SHADER_STAGE_COMPUTE_BIT)
        require_local_size(device.limits(), pipeline, reflected_.local_size);
    else
        require_varyings(device.limits(), pipeline, name_, reflected_.varying_locations);
    const std::vector<std::uint32_t> words =
        device.capabilities().texel_buffers ? specialised.words : texels_as_storage(specialised.words);
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = words.size() * sizeof(std::uint32_t);
    info.pCode = words.data();
    // This comes last: an exception after the module's creation would leak it, since the destructor would not run.
    create_handle(vkCreateShaderModule, device.handle(), info, module_, "vkCreateShaderModule", name_);
}

bool ShaderStage::has_constant(std::string_view name) const { return constants_.contains(name); }

ShaderStage::~ShaderStage() { vkDestroyShaderModule(device_.handle(), module_, nullptr); }

VkPipelineShaderStageCreateInfo ShaderStage::create_info() const {
    auto info = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = reflected_.stage;
    info.module = module_;
    info.pName = "main";
    if (has_constant(subgroup_constant)) info.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    return info;
}

void require_constants(const std::string& pipeline, std::span<const SpecializationConstant> constants,
                       std::span<const ShaderStage* const> stages) {
    for (const SpecializationConstant& constant : constants) {
        const bool known = std::any_of(stages.begin(), stages.end(),
                                       [&](const ShaderStage* stage) { return stage->has_constant(constant.name); });
        if (!known) {
            throw VulkanError(
                fmt::format("pipeline {}: no shader has the specialization constant '{}'", pipeline, constant.name));
        }
    }
}

}  // namespace drape::vulkan
