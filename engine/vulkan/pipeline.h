// Pipelines have one set of descriptors (set 0, bound by Descriptors); their layouts are derived from the shader
// modules.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/specialisation.h"

namespace drape::vulkan {

/// The shader of a stage, found by its name.
struct Shader {
    std::string module;                         ///< "spring.comp"; empty: none
    std::span<const std::uint32_t> words = {};  ///< tests pass this SPIR-V instead of the module of that name
};

/// A texel buffer is a storage buffer on a device without those that Drape needs.
VkDescriptorType descriptor_type(const Device& device, DescriptorKind kind);

class ShaderStage;

/// The common base of compute and graphics pipelines.
class Pipeline {
  public:
    virtual ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
    VkPipeline handle() const { return handle_; }
    VkPipelineLayout layout() const { return layout_; }
    VkDescriptorSetLayout set_layout() const { return set_layout_; }
    VkPipelineBindPoint bind_point() const { return bind_point_; }
    const std::string& name() const { return name_; }
    /// Returns the descriptors that the specialised stages use, all stages together, sorted by binding.
    const std::vector<ReflectedDescriptor>& descriptors() const { return descriptors_; }
    const std::optional<ReflectedStruct>& push_constants() const { return push_constants_; }
    VkShaderStageFlags push_constant_stages() const { return push_constant_stages_; }

  protected:
    Pipeline(const Device& device, std::string name, VkPipelineBindPoint bind_point);
    /// Makes the set layout and the pipeline layout of all stages together; throws VulkanError where stages contradict
    /// each other.
    void make_layout(std::span<const ShaderStage* const> stages);

    const Device& device_;
    std::string name_;
    VkPipeline handle_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineBindPoint bind_point_;
    std::vector<ReflectedDescriptor> descriptors_;
    std::optional<ReflectedStruct> push_constants_;
    VkShaderStageFlags push_constant_stages_ = 0;

  private:
    void merge(const ShaderStage& stage);
    void make_layout_handles();
};

class ComputePipeline : public Pipeline {
  public:
    /// Throws VulkanError when the module is missing, is no compute shader, uses something that Drape does not use,
    /// lacks a given constant, or exceeds the device's limits.
    ComputePipeline(const Device& device, std::string name, const Shader& shader,
                    std::span<const SpecializationConstant> constants);
    /// Returns the size of the workgroup after specialisation.
    std::array<std::uint32_t, 3> local_size() const { return local_size_; }

  private:
    std::array<std::uint32_t, 3> local_size_{};
};

struct GraphicsState {
    Shader vertex;
    Shader fragment;                                  ///< an empty module name means none (depth-only passes)
    std::vector<SpecializationConstant> constants;    ///< each is set in the stages that have it
    VkFormat color_format = VK_FORMAT_R8G8B8A8_SRGB;  ///< VK_FORMAT_UNDEFINED: no colour attachment
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;     ///< VK_FORMAT_UNDEFINED: no depth test
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkCompareOp depth_compare = VK_COMPARE_OP_LESS;
};

/// Draws triangle lists without vertex buffers; viewport and scissor are dynamic, and so is rendering.
class GraphicsPipeline : public Pipeline {
  public:
    /// Throws as ComputePipeline does, and when descriptors are not read only or differ between the two stages.
    GraphicsPipeline(const Device& device, std::string name, const GraphicsState& state);
};

}  // namespace drape::vulkan
