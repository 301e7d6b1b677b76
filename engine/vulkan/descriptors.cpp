#include "vulkan/descriptors.h"

#include <algorithm>

#include "vulkan/api.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

constexpr std::uint32_t sets_of_pool = 64, descriptors_of_set = 8;  // of each type
constexpr std::array<VkDescriptorType, 3> types = {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                   VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER};

}  // namespace

Descriptors::~Descriptors() {
    for (const VkDescriptorPool pool : pools_) vkDestroyDescriptorPool(device_.handle(), pool, nullptr);
}

void Descriptors::bind(VkCommandBuffer commands, const Pipeline& pipeline, std::span<VkWriteDescriptorSet> writes) {
    const auto count = static_cast<std::uint32_t>(writes.size());
    if (device_.capabilities().push_descriptors) {
        vkCmdPushDescriptorSetKHR(commands, pipeline.bind_point(), pipeline.layout(), 0, count, writes.data());
        return;
    }
    const VkDescriptorSet set = take(pipeline, writes);
    for (VkWriteDescriptorSet& write : writes) write.dstSet = set;
    vkUpdateDescriptorSets(device_.handle(), count, writes.data(), 0, nullptr);
    vkCmdBindDescriptorSets(commands, pipeline.bind_point(), pipeline.layout(), 0, 1, &set, 0, nullptr);
}

VkDescriptorSet Descriptors::take(const Pipeline& pipeline, std::span<const VkWriteDescriptorSet> writes) {
    std::array<std::uint32_t, types.size()> needed{};
    for (const VkWriteDescriptorSet& write : writes)
        needed[static_cast<std::size_t>(std::ranges::find(types, write.descriptorType) - types.begin())] +=
            write.descriptorCount;
    if (sets_left_ == 0 || !std::ranges::equal(needed, left_, std::ranges::less_equal())) {
        std::array<VkDescriptorPoolSize, types.size()> sizes;
        for (std::size_t k = 0; k < types.size(); ++k) {
            left_[k] = std::max(needed[k], sets_of_pool * descriptors_of_set);
            sizes[k] = {types[k], left_[k]};
        }
        auto info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
        info.maxSets = sets_left_ = sets_of_pool;
        info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
        info.pPoolSizes = sizes.data();
        VkDescriptorPool pool = VK_NULL_HANDLE;
        create_handle(vkCreateDescriptorPool, device_.handle(), info, pool, "vkCreateDescriptorPool", pipeline.name());
        pools_.push_back(pool);
    }
    auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    const VkDescriptorSetLayout layout = pipeline.set_layout();
    info.descriptorPool = pools_.back();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(device_.handle(), &info, &set), "vkAllocateDescriptorSets", pipeline.name());
    --sets_left_;
    for (std::size_t k = 0; k < types.size(); ++k) left_[k] -= needed[k];
    return set;
}

}  // namespace drape::vulkan
