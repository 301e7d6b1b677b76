#include "vulkan/shader_stage.h"

#include <fmt/format.h>

#include <algorithm>

#include "vulkan/api.h"
#include "vulkan/structure.h"

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

/// Throws a VulkanError that names all of the module that Drape does not use.
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

}  // namespace

ShaderStage::ShaderStage(const Device& device, const std::string& pipeline, const Shader& shader,
                         VkShaderStageFlagBits stage, std::span<const SpecializationConstant> constants)
    : device_(device), name_(shader.module) {
    const std::span<const std::uint32_t> words = shader.words.empty() ? spirv_module(name_) : shader.words;
    reflected_ = reflect(words, name_);
    if (reflected_.stage != stage) {
        throw VulkanError(fmt::format("pipeline {}: shader module {} is a {} shader, not a {} shader", pipeline, name_,
                                      stage_name(reflected_.stage), stage_name(stage)));
    }
    require_known(pipeline, name_, reflected_);
    specialise(constants);
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    // This comes last, so that nothing can throw while the module is owned and the destructor not yet in charge.
    create_handle(vkCreateShaderModule, device.handle(), info, module_, "vkCreateShaderModule", name_);
}

void ShaderStage::specialise(std::span<const SpecializationConstant> constants) {
    local_size_ = reflected_.local_size;
    for (const SpecializationConstant& constant : constants) {
        const auto found = reflected_.constants.find(constant.name);
        if (found == reflected_.constants.end()) continue;  // it is another stage's
        const auto offset = static_cast<std::uint32_t>(values_.size() * sizeof(std::uint32_t));
        entries_.push_back({found->second, offset, sizeof(std::uint32_t)});
        values_.push_back(constant.value);
        for (std::size_t axis = 0; axis < local_size_.size(); ++axis)
            if (constant.name == local_size_names[axis]) local_size_[axis] = constant.value;
    }
    specialization_ = {static_cast<std::uint32_t>(entries_.size()), entries_.data(),
                       values_.size() * sizeof(std::uint32_t), values_.data()};
}

bool ShaderStage::leaves_out(const ReflectedDescriptor& descriptor) const {
    const auto constant = reflected_.constants.find("has_" + descriptor.name);
    if (constant == reflected_.constants.end()) return false;
    const auto entry = std::ranges::find(entries_, constant->second, &VkSpecializationMapEntry::constantID);
    return entry == entries_.end() || values_[static_cast<std::size_t>(entry - entries_.begin())] == 0;
}

ShaderStage::~ShaderStage() { vkDestroyShaderModule(device_.handle(), module_, nullptr); }

VkPipelineShaderStageCreateInfo ShaderStage::create_info() const {
    auto info = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = reflected_.stage;
    info.module = module_;
    info.pName = "main";
    info.pSpecializationInfo = &specialization_;
    if (reflected_.constants.contains(subgroup_constant))
        info.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    return info;
}

void require_constants(const std::string& pipeline, std::span<const SpecializationConstant> constants,
                       std::span<const ShaderStage* const> stages) {
    for (const SpecializationConstant& constant : constants) {
        const bool known = std::any_of(stages.begin(), stages.end(), [&](const ShaderStage* stage) {
            return stage->reflected().constants.contains(constant.name);
        });
        if (!known) {
            throw VulkanError(
                fmt::format("pipeline {}: no shader has the specialization constant '{}'", pipeline, constant.name));
        }
    }
}

}  // namespace drape::vulkan
