// How the descriptors of pipelines are bound.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vulkan/pipeline.h"

namespace drape::vulkan {

/// Binds descriptors while commands are recorded: pushes them or, on a device that cannot, takes sets from pools that
/// live as long as this object, which the commands must not outlive.
class Descriptors {
  public:
    explicit Descriptors(const Device& device) : device_(device) {}
    ~Descriptors();
    Descriptors(const Descriptors&) = delete;
    Descriptors& operator=(const Descriptors&) = delete;

    /// Binds the pipeline's set 0; `writes` have no set yet.
    void bind(VkCommandBuffer commands, const Pipeline& pipeline, std::span<VkWriteDescriptorSet> writes);

  private:
    VkDescriptorSet take(const Pipeline& pipeline, std::span<const VkWriteDescriptorSet> writes);

    const Device& device_;
    std::vector<VkDescriptorPool> pools_;
    std::uint32_t sets_left_ = 0;          ///< of the last pool
    std::array<std::uint32_t, 3> left_{};  ///< of its descriptors, by DescriptorKind
};

}  // namespace drape::vulkan
