// The checker is checked: a planted hazard must be reported, every time, and only real ones may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "gpu_test.h"
#include "vulkan/api.h"
#include "vulkan/descriptors.h"
#include "vulkan/pipeline.h"
#include "vulkan/resources.h"
#include "vulkan/structure.h"

namespace drape::test {

using testing::Contains;
using testing::HasSubstr;
using vulkan::Image;
using vulkan::structure;

namespace {

constexpr std::uint32_t width = 101, height = 7;

Image make_image(const char* name) {
    return Image(gpu().device,
                 {name, VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                  VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
}

/// Three images, the first filled with `texels`, the others with zero.
struct Chain {
    vulkan::ComputePipeline copy{gpu().device, "canary", {"canary.comp"}, {}};
    Image first = make_image("first"), second = make_image("second"), third = make_image("third");
    std::vector<float> texels = std::vector<float>(width * height * 4);
    mutable vulkan::Descriptors descriptors{gpu().device};

    Chain() {
        for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(i) + 0.25f;
        const std::vector<float> zeros(texels.size());
        upload(gpu().device, first, std::as_bytes(std::span(texels)));
        for (const Image* image : {&second, &third}) upload(gpu().device, *image, std::as_bytes(std::span(zeros)));
    }

    void record_copy(VkCommandBuffer commands, const Image& from, const Image& to) const {
        vkCmdBindPipeline(commands, copy.bind_point(), copy.handle());
        VkDescriptorImageInfo images[2] = {{VK_NULL_HANDLE, from.view(), VK_IMAGE_LAYOUT_GENERAL},
                                           {VK_NULL_HANDLE, to.view(), VK_IMAGE_LAYOUT_GENERAL}};
        VkWriteDescriptorSet writes[2];
        for (std::uint32_t i = 0; i < 2; ++i) {
            writes[i] = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
            writes[i].dstBinding = i;
            writes[i].descriptorCount = 1;
            writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            writes[i].pImageInfo = &images[i];
        }
        descriptors.bind(commands, copy, writes);
        const auto [x, y, z] = copy.local_size();
        vkCmdDispatch(commands, (width + x - 1) / x, (height + y - 1) / y, 1);
    }

    void run(bool with_barrier) const {
        gpu().device.run_once([&](VkCommandBuffer commands) {
            record_copy(commands, first, second);
            if (with_barrier) barrier(commands);
            record_copy(commands, second, third);
        });
    }

    static void barrier(VkCommandBuffer commands) {
        auto memory = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
        memory.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        memory.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        memory.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        memory.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
        auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &memory;
        vkCmdPipelineBarrier2(commands, &dependency);
    }
};

}  // namespace

TEST(VulkanCanary, a_chain_with_its_barrier_copies_and_is_clean) {
    const Chain chain;
    chain.run(true);
    std::vector<float> received(chain.texels.size());
    download(gpu().device, chain.third, std::as_writable_bytes(std::span(received)));
    EXPECT_EQ(received, chain.texels);
    EXPECT_EQ(gpu().instance.validation_log().count(), 0u);
}

TEST(VulkanCanary, a_missing_barrier_is_reported) {
    const Chain chain;
    const ExpectValidationMessages expected;
    chain.run(false);
    EXPECT_THAT(expected.messages(), Contains(HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE")));
    EXPECT_THAT(expected.messages(), Contains(HasSubstr("second"))) << "the resource is named";
}

TEST(VulkanCanary, a_hazard_is_still_reported_after_many_of_its_kind) {
    // The layer can mute a message that it gave often; then a canary early on would hide real findings.
    const Chain chain;
    for (int i = 0; i < 30; ++i) {
        const ExpectValidationMessages expected;
        chain.run(false);
        ASSERT_EQ(gpu().instance.validation_log().count(), 1u) << "run " << i;
    }
}

TEST(VulkanCanary, one_image_read_and_written_through_two_views_is_no_hazard_within_a_dispatch) {
    // Images that a pass updates in place are bound so: it is sound, and hazards are seen across dispatches.
    const Chain chain;
    gpu().device.run_once([&](VkCommandBuffer commands) {
        chain.record_copy(commands, chain.first, chain.first);
        Chain::barrier(commands);
        chain.record_copy(commands, chain.first, chain.second);
    });
    EXPECT_EQ(gpu().instance.validation_log().count(), 0u);
    const ExpectValidationMessages expected;
    gpu().device.run_once([&](VkCommandBuffer commands) {
        chain.record_copy(commands, chain.first, chain.first);
        chain.record_copy(commands, chain.first, chain.first);
    });
    EXPECT_THAT(expected.messages(), Contains(HasSubstr("SYNC-HAZARD")));
}

TEST(VulkanCanary, the_filter_for_copies_in_general_lets_real_layout_errors_through) {
    const Chain chain;
    std::vector<std::byte> bytes(chain.texels.size() * sizeof(float));
    for (int i = 0; i < 15; ++i) download(gpu().device, chain.first, bytes);  // each causes a filtered message
    EXPECT_EQ(gpu().instance.validation_log().count(), 0u);
    const vulkan::Buffer target(gpu().device, {"target", bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    const ExpectValidationMessages expected;
    gpu().device.run_once([&](VkCommandBuffer commands) {
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {width, height, 1};
        // The image rests in GENERAL, so this layout is a lie.
        vkCmdCopyImageToBuffer(commands, chain.first.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.handle(), 1,
                               &region);
    });
    EXPECT_THAT(expected.messages(), Contains(HasSubstr("TRANSFER_SRC_OPTIMAL")));
}

}  // namespace drape::test
