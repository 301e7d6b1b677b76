#include "vulkan/pipeline.h"

#include <fmt/format.h>
#include <volk.h>

#include <algorithm>
#include <map>

#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

VkDescriptorType descriptor_type(DescriptorKind kind) {
    return kind == DescriptorKind::storage_image ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

bool same_binding(const DescriptorDeclaration& a, const DescriptorDeclaration& b) {
    return a.name == b.name && a.kind == b.kind && a.access == b.access && a.format == b.format &&
           a.element == b.element && a.stride == b.stride;
}

/// `pipeline` may push this many storage images and buffers per stage.
void require_counts(const Device& device, const std::string& pipeline, const ShaderInterface& shader) {
    const auto images = static_cast<std::uint32_t>(
        std::count_if(shader.descriptors.begin(), shader.descriptors.end(),
                      [](const DescriptorDeclaration& d) { return d.kind == DescriptorKind::storage_image; }));
    const auto buffers = static_cast<std::uint32_t>(shader.descriptors.size()) - images;
    const VkPhysicalDeviceLimits& limits = device.limits();
    if (images > limits.maxPerStageDescriptorStorageImages) {
        throw VulkanError(fmt::format("pipeline {}: {} has {} storage images, the device's limit is {}", pipeline,
                                      shader.module, images, limits.maxPerStageDescriptorStorageImages));
    }
    if (buffers > limits.maxPerStageDescriptorStorageBuffers) {
        throw VulkanError(fmt::format("pipeline {}: {} has {} storage buffers, the device's limit is {}", pipeline,
                                      shader.module, buffers, limits.maxPerStageDescriptorStorageBuffers));
    }
}

}  // namespace

Pipeline::Pipeline(const Device& device, std::string name, VkPipelineBindPoint bind_point)
    : device_(device), name_(std::move(name)), bind_point_(bind_point) {}

Pipeline::~Pipeline() {
    vkDestroyPipeline(device_.handle(), handle_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

void Pipeline::make_layout(std::span<const std::pair<VkShaderStageFlagBits, ShaderInterface>> stages) {
    std::map<std::uint32_t, VkDescriptorSetLayoutBinding> bindings;
    for (const auto& [stage, shader] : stages) {
        require_counts(device_, name_, shader);
        for (const DescriptorDeclaration& descriptor : shader.descriptors) {
            const auto [binding, is_new] = bindings.try_emplace(descriptor.binding);
            if (is_new) {
                binding->second = {descriptor.binding, descriptor_type(descriptor.kind), 1, 0, nullptr};
                descriptors_.push_back(descriptor);
            }
            binding->second.stageFlags |= stage;
            const auto first = std::find_if(descriptors_.begin(), descriptors_.end(),
                                            [&](const auto& other) { return other.binding == descriptor.binding; });
            if (!same_binding(*first, descriptor)) {
                throw VulkanError(
                    fmt::format("pipeline {}: binding {} is {} in one stage and {}, or declared "
                                "otherwise, in another",
                                name_, descriptor.binding, first->name, descriptor.name));
            }
        }
        if (shader.push_constants) {
            push_constant_stages_ |= stage;
            push_constant_size_ = std::max(push_constant_size_, shader.push_constants->size);
        }
    }
    std::sort(descriptors_.begin(), descriptors_.end(),
              [](const auto& a, const auto& b) { return a.binding < b.binding; });
    make_layout_handles(bindings);
}

void Pipeline::make_layout_handles(const std::map<std::uint32_t, VkDescriptorSetLayoutBinding>& bindings) {
    if (bindings.size() > device_.max_push_descriptors()) {
        throw VulkanError(fmt::format("pipeline {} has {} descriptors, the device can push {}", name_, bindings.size(),
                                      device_.max_push_descriptors()));
    }
    if (push_constant_size_ > device_.limits().maxPushConstantsSize) {
        throw VulkanError(fmt::format("pipeline {} has {} bytes of push constants, the device's limit is {}", name_,
                                      push_constant_size_, device_.limits().maxPushConstantsSize));
    }
    std::vector<VkDescriptorSetLayoutBinding> sorted;
    for (const auto& [number, binding] : bindings) sorted.push_back(binding);
    auto set = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
    set.bindingCount = static_cast<std::uint32_t>(sorted.size());
    set.pBindings = sorted.data();
    create_handle(vkCreateDescriptorSetLayout, device_.handle(), set, set_layout_, "vkCreateDescriptorSetLayout",
                  name_);
    const VkPushConstantRange range{push_constant_stages_, 0, push_constant_size_};
    auto layout = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    layout.pushConstantRangeCount = push_constant_size_ > 0 ? 1 : 0;
    layout.pPushConstantRanges = &range;
    create_handle(vkCreatePipelineLayout, device_.handle(), layout, layout_, "vkCreatePipelineLayout", name_);
    device_.set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, reinterpret_cast<std::uint64_t>(layout_), name_);
}

}  // namespace drape::vulkan
