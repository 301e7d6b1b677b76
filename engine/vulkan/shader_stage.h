#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/pipeline.h"
#include "vulkan/reflection.h"

namespace drape::vulkan {

/// One specialised stage of a pipeline that is being made. It finds the module, checks that it is of the stage and uses
/// nothing that Drape does not, makes the VkShaderModule and keeps it while the pipeline is created.
class ShaderStage {
  public:
    ShaderStage(const Device& device, const std::string& pipeline, const Shader& shader, VkShaderStageFlagBits stage,
                std::span<const SpecializationConstant> constants);
    ~ShaderStage();
    ShaderStage(const ShaderStage&) = delete;
    ShaderStage& operator=(const ShaderStage&) = delete;

    /// Returns a structure that points into this object.
    VkPipelineShaderStageCreateInfo create_info() const;
    const ReflectedModule& reflected() const { return reflected_; }
    const std::string& module() const { return name_; }
    /// Returns the size as specialised.
    std::array<std::uint32_t, 3> local_size() const { return local_size_; }
    /// Returns whether a descriptor is not used as specialised: a constant has_NAME says so (default: false).
    bool leaves_out(const ReflectedDescriptor& descriptor) const;

  private:
    void specialise(std::span<const SpecializationConstant> constants);

    const Device& device_;
    std::string name_;
    ReflectedModule reflected_;
    std::array<std::uint32_t, 3> local_size_{};
    VkShaderModule module_ = VK_NULL_HANDLE;
    std::vector<std::uint32_t> values_;
    std::vector<VkSpecializationMapEntry> entries_;
    VkSpecializationInfo specialization_{};
};

/// Throws VulkanError when a constant is in none of the stages: a wrong name would silently change nothing.
void require_constants(const std::string& pipeline, std::span<const SpecializationConstant> constants,
                       std::span<const ShaderStage* const> stages);

}  // namespace drape::vulkan
