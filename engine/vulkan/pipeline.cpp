#include "vulkan/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "vulkan/api.h"
#include "vulkan/shader_stage.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

/// Throws unless `pipeline` may use this many storage images and buffers per stage.
void require_counts(const Device& device, const std::string& pipeline, const ShaderStage& stage) {
    const std::vector<ReflectedDescriptor>& all = stage.reflected().descriptors;
    const auto buffers = static_cast<std::uint32_t>(std::ranges::count_if(all, [&](const ReflectedDescriptor& each) {
        return descriptor_type(device, *each.kind) == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }));
    const auto images = static_cast<std::uint32_t>(all.size()) - buffers;  // Vulkan counts texel buffers as images
    const VkPhysicalDeviceLimits& limits = device.limits();
    if (images > limits.maxPerStageDescriptorStorageImages) {
        throw VulkanError(fmt::format("pipeline {}: {} has {} storage images, the device's limit is {}", pipeline,
                                      stage.module(), images, limits.maxPerStageDescriptorStorageImages));
    }
    if (buffers > limits.maxPerStageDescriptorStorageBuffers) {
        throw VulkanError(fmt::format("pipeline {}: {} has {} storage buffers, the device's limit is {}", pipeline,
                                      stage.module(), buffers, limits.maxPerStageDescriptorStorageBuffers));
    }
}

}  // namespace

VkDescriptorType descriptor_type(const Device& device, DescriptorKind kind) {
    switch (kind) {
        case DescriptorKind::storage_image:
            return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        case DescriptorKind::storage_buffer:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        case DescriptorKind::texel_buffer:
            return device.capabilities().texel_buffers ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                                       : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    throw std::logic_error("no such kind of descriptor");
}

Pipeline::Pipeline(const Device& device, std::string name, VkPipelineBindPoint bind_point)
    : device_(device), name_(std::move(name)), bind_point_(bind_point) {}

Pipeline::~Pipeline() {
    vkDestroyPipeline(device_.handle(), handle_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

void Pipeline::make_layout(std::span<const ShaderStage* const> stages) {
    for (const ShaderStage* stage : stages) {
        require_counts(device_, name_, *stage);
        merge(*stage);
    }
    std::ranges::sort(descriptors_, {}, &ReflectedDescriptor::binding);
    make_layout_handles();
}

void Pipeline::merge(const ShaderStage& stage) {
    const ReflectedModule& module = stage.reflected();
    for (const ReflectedDescriptor& descriptor : module.descriptors) {
        const auto other = std::ranges::find_if(descriptors_, [&](const ReflectedDescriptor& known) {
            return known.binding == descriptor.binding || known.name == descriptor.name;
        });
        if (other == descriptors_.end()) {
            descriptors_.push_back(descriptor);
            continue;
        }
        ReflectedDescriptor same = descriptor;
        same.stages = other->stages;
        if (same != *other)
            throw VulkanError(
                fmt::format("pipeline {}: '{}' at binding {} of {} is not the '{}' at binding {} that was there before",
                            name_, descriptor.name, descriptor.binding, stage.module(), other->name, other->binding));
        other->stages |= module.stage;
    }
    if (!module.push_constants) return;
    if (push_constants_ && push_constants_ != module.push_constants)
        throw VulkanError(fmt::format("pipeline {}: the push constants {} of {} are not the {} of another stage", name_,
                                      module.push_constants->name, stage.module(), push_constants_->name));
    push_constants_ = module.push_constants;
    push_constant_stages_ |= module.stage;
}

void Pipeline::make_layout_handles() {
    const std::uint32_t push_constant_size = push_constants_ ? push_constants_->size : 0;
    const bool pushes = device_.capabilities().push_descriptors;
    if (pushes && descriptors_.size() > device_.capabilities().max_push_descriptors) {
        throw VulkanError(fmt::format("pipeline {} has {} descriptors, the device can push {}", name_,
                                      descriptors_.size(), device_.capabilities().max_push_descriptors));
    }
    if (push_constant_size > device_.limits().maxPushConstantsSize) {
        throw VulkanError(fmt::format("pipeline {} has {} bytes of push constants, the device's limit is {}", name_,
                                      push_constant_size, device_.limits().maxPushConstantsSize));
    }
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const ReflectedDescriptor& descriptor : descriptors_)
        bindings.push_back(
            {descriptor.binding, descriptor_type(device_, *descriptor.kind), 1, descriptor.stages, nullptr});
    auto set = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set.flags = pushes ? VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR : 0;
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    create_handle(vkCreateDescriptorSetLayout, device_.handle(), set, set_layout_, "vkCreateDescriptorSetLayout",
                  name_);
    const VkPushConstantRange range{push_constant_stages_, 0, push_constant_size};
    auto layout = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    layout.pushConstantRangeCount = push_constant_size > 0 ? 1 : 0;
    layout.pPushConstantRanges = &range;
    create_handle(vkCreatePipelineLayout, device_.handle(), layout, layout_, "vkCreatePipelineLayout", name_);
    device_.set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, reinterpret_cast<std::uint64_t>(layout_), name_);
}

}  // namespace drape::vulkan
