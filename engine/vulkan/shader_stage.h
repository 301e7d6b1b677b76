// One checked and specialised stage of a pipeline that is being made.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/pipeline.h"
#include "vulkan/reflection.h"

namespace drape::vulkan {

/// Finds the module, checks stage and interface, makes the VkShaderModule and keeps it as long as the
/// pipeline's creation needs it.
class ShaderStage {
  public:
    ShaderStage(const Device& device, const std::string& pipeline, const ShaderInterface& shader,
                VkShaderStageFlagBits stage, std::span<const SpecializationConstant> constants);
    ~ShaderStage();
    ShaderStage(const ShaderStage&) = delete;
    ShaderStage& operator=(const ShaderStage&) = delete;

    /// Points into this object.
    VkPipelineShaderStageCreateInfo create_info() const;
    const ReflectedModule& reflected() const { return reflected_; }
    bool has_constant(std::uint32_t id) const;

  private:
    const Device& device_;
    ReflectedModule reflected_;
    VkShaderModule module_ = VK_NULL_HANDLE;
    std::vector<SpecializationConstant> constants_;
    std::vector<VkSpecializationMapEntry> entries_;
    VkSpecializationInfo specialization_{};
};

/// Throws VulkanError when a constant is in none of the stages: a wrong id would silently change nothing.
void require_constants(const std::string& pipeline, std::span<const SpecializationConstant> constants,
                       std::span<const ShaderStage* const> stages);

}  // namespace drape::vulkan
