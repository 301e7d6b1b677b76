#include "vulkan/shader_stage.h"

#include <fmt/format.h>
#include <volk.h>

#include <algorithm>
#include <cstddef>

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

}  // namespace

ShaderStage::ShaderStage(const Device& device, const std::string& pipeline, const ShaderInterface& shader,
                         VkShaderStageFlagBits stage, std::span<const SpecializationConstant> constants)
    : device_(device), constants_(constants.begin(), constants.end()) {
    const std::span<const std::uint32_t> words = shader.words.empty() ? spirv_module(shader.module) : shader.words;
    reflected_ = reflect(words, shader.module);
    if (reflected_.stage != stage) {
        throw VulkanError(fmt::format("pipeline {}: shader module {} is a {} shader, not a {} shader", pipeline,
                                      shader.module, stage_name(reflected_.stage), stage_name(stage)));
    }
    require_match(reflected_, shader);
    for (std::uint32_t i = 0; i < constants_.size(); ++i) {
        const auto offset =
            static_cast<std::uint32_t>(i * sizeof(SpecializationConstant) + offsetof(SpecializationConstant, value));
        entries_.push_back({constants_[i].id, offset, sizeof(SpecializationConstant::value)});
    }
    specialization_ = {static_cast<std::uint32_t>(entries_.size()), entries_.data(),
                       constants_.size() * sizeof(SpecializationConstant), constants_.data()};
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    // Last, so that nothing can throw while the module is owned and the destructor not yet in charge.
    create_handle(vkCreateShaderModule, device.handle(), info, module_, "vkCreateShaderModule", shader.module);
}

ShaderStage::~ShaderStage() { vkDestroyShaderModule(device_.handle(), module_, nullptr); }

VkPipelineShaderStageCreateInfo ShaderStage::create_info() const {
    auto info = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = reflected_.stage;
    info.module = module_;
    info.pName = "main";
    info.pSpecializationInfo = &specialization_;
    return info;
}

bool ShaderStage::has_constant(std::uint32_t id) const {
    return std::find(reflected_.constant_ids.begin(), reflected_.constant_ids.end(), id) !=
           reflected_.constant_ids.end();
}

void require_constants(const std::string& pipeline, std::span<const SpecializationConstant> constants,
                       std::span<const ShaderStage* const> stages) {
    for (const SpecializationConstant& constant : constants) {
        const bool known = std::any_of(stages.begin(), stages.end(),
                                       [&](const ShaderStage* stage) { return stage->has_constant(constant.id); });
        if (!known) {
            throw VulkanError(
                fmt::format("pipeline {}: no shader has the specialization constant {}", pipeline, constant.id));
        }
    }
}

}  // namespace drape::vulkan
