#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/pipeline.h"

namespace drape::vulkan {

/// One specialised stage of a pipeline under construction. It finds the module, checks its stage and that, after
/// specialisation, it uses nothing that Drape does not use, and keeps the VkShaderModule while the pipeline is created.
class ShaderStage {
  public:
    ShaderStage(const Device& device, const std::string& pipeline, const Shader& shader, VkShaderStageFlagBits stage,
                std::span<const SpecializationConstant> constants);
    ~ShaderStage();
    ShaderStage(const ShaderStage&) = delete;
    ShaderStage& operator=(const ShaderStage&) = delete;

    /// Returns a structure that names this object's module.
    VkPipelineShaderStageCreateInfo create_info() const;
    const ReflectedModule& reflected() const { return reflected_; }
    /// Returns whether the module, before specialisation, has a constant with this name.
    bool has_constant(std::string_view name) const;
    const std::string& module() const { return name_; }

  private:
    const Device& device_;
    std::string name_;
    std::map<std::string, std::uint32_t, std::less<>> constants_;
    ReflectedModule reflected_;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

/// Throws VulkanError when no stage has one of the constants: a wrong name would silently change nothing.
void require_constants(const std::string& pipeline, std::span<const SpecializationConstant> constants,
                       std::span<const ShaderStage* const> stages);

}  // namespace drape::vulkan
