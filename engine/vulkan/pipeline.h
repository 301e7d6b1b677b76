// Compute and graphics pipelines with push descriptors (set 0); interfaces checked when they are made.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/shader_interface.h"

namespace drape::vulkan {

/// constant_id -> 32-bit value (floats by std::bit_cast).
struct SpecializationConstant {
    std::uint32_t id;
    std::uint32_t value;
};

/// What every pipeline has; descriptors are pushed at record time (VK_KHR_push_descriptor), so no pools.
class Pipeline {
  public:
    virtual ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
    VkPipeline handle() const { return handle_; }
    VkPipelineLayout layout() const { return layout_; }
    VkPipelineBindPoint bind_point() const { return bind_point_; }
    const std::string& name() const { return name_; }
    /// Union over the stages, sorted by binding.
    const std::vector<DescriptorDeclaration>& descriptors() const { return descriptors_; }
    std::uint32_t push_constant_size() const { return push_constant_size_; }
    VkShaderStageFlags push_constant_stages() const { return push_constant_stages_; }

  protected:
    Pipeline(const Device& device, std::string name, VkPipelineBindPoint bind_point);
    /// Set layout (stages of each descriptor merged) and pipeline layout.
    void make_layout(std::span<const std::pair<VkShaderStageFlagBits, ShaderInterface>> stages);

    const Device& device_;
    std::string name_;
    VkPipeline handle_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineBindPoint bind_point_;
    std::vector<DescriptorDeclaration> descriptors_;
    std::uint32_t push_constant_size_ = 0;
    VkShaderStageFlags push_constant_stages_ = 0;

  private:
    void make_layout_handles(const std::map<std::uint32_t, VkDescriptorSetLayoutBinding>& bindings);
};

class ComputePipeline : public Pipeline {
  public:
    /// Throws VulkanError when the module is missing, is no compute shader, differs from its declaration, has
    /// no constant of a given id, or goes beyond the device's limits.
    ComputePipeline(const Device& device, std::string name, const ShaderInterface& shader,
                    std::span<const SpecializationConstant> constants);
    /// As specialised.
    std::array<std::uint32_t, 3> local_size() const { return local_size_; }

  private:
    std::array<std::uint32_t, 3> local_size_{};
};

struct GraphicsState {
    ShaderInterface vertex;
    ShaderInterface fragment;                         ///< an empty module name: none (depth-only passes)
    std::vector<SpecializationConstant> constants;    ///< given to both stages; ids are shared
    VkFormat color_format = VK_FORMAT_R8G8B8A8_SRGB;  ///< VK_FORMAT_UNDEFINED: no colour attachment
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;     ///< VK_FORMAT_UNDEFINED: no depth test
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    bool depth_write = true;
};

/// Triangle list, no vertex buffers, dynamic viewport and scissor, dynamic rendering, depth LESS.
class GraphicsPipeline : public Pipeline {
  public:
    /// Throws as ComputePipeline does; and descriptors of these stages must be read only.
    GraphicsPipeline(const Device& device, std::string name, const GraphicsState& state);
};

}  // namespace drape::vulkan
