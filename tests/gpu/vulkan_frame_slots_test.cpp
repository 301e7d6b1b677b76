// Two frames in flight are submitted and waited for, and misuse is refused.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <thread>

#include "gpu_test.h"
#include "vulkan/api.h"
#include "vulkan/frame_slots.h"
#include "vulkan/resources.h"
#include "vulkan/structure.h"

namespace drape::test {

using vulkan::Buffer;
using vulkan::BufferHome;
using vulkan::FrameSlots;
using vulkan::structure;

namespace {

/// Each slot has one reusable command buffer, which fills the slot's word of a host-visible buffer.
class Fills {
  public:
    Fills() : target_(gpu().device, {"words", 8, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferHome::readback}) {
        const vulkan::Device& device = gpu().device;
        auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
        pool.queueFamilyIndex = device.queue_family();
        vulkan::create_handle(vkCreateCommandPool, device.handle(), pool, pool_, "vkCreateCommandPool", "test");
        auto info = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
        info.commandPool = pool_;
        info.commandBufferCount = vulkan::frame_slot_count;
        vulkan::check(vkAllocateCommandBuffers(device.handle(), &info, commands_.data()), "vkAllocateCommandBuffers");
        for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot) record(slot);
    }
    ~Fills() { vkDestroyCommandPool(gpu().device.handle(), pool_, nullptr); }
    Fills(const Fills&) = delete;
    Fills& operator=(const Fills&) = delete;

    VkCommandBuffer commands(std::uint32_t slot) const { return commands_[slot]; }
    std::uint32_t& word(std::uint32_t slot) { return reinterpret_cast<std::uint32_t*>(target_.mapped().data())[slot]; }

  private:
    void record(std::uint32_t slot) {
        const auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        vulkan::check(vkBeginCommandBuffer(commands_[slot], &begin), "vkBeginCommandBuffer");
        vkCmdFillBuffer(commands_[slot], target_.handle(), slot * 4, 4, slot + 100);
        auto barrier = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands_[slot], &dependency);
        vulkan::check(vkEndCommandBuffer(commands_[slot]), "vkEndCommandBuffer");
    }

    Buffer target_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::array<VkCommandBuffer, vulkan::frame_slot_count> commands_{};
};

}  // namespace

TEST(VulkanFrameSlots, a_waited_slot_has_done_its_work_and_can_be_submitted_again) {
    Fills fills;
    FrameSlots slots(gpu().device);
    for (int frame = 0; frame < 20; ++frame) {
        const auto slot = static_cast<std::uint32_t>(frame) % vulkan::frame_slot_count;
        slots.wait(slot);
        if (frame >= 2) {
            EXPECT_EQ(fills.word(slot), slot + 100) << "frame " << frame;
        }
        fills.word(slot) = 0;
        slots.submit(slot, fills.commands(slot));
        EXPECT_TRUE(slots.pending(slot));
    }
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot) {
        slots.wait(slot);
        EXPECT_FALSE(slots.pending(slot));
        EXPECT_EQ(fills.word(slot), slot + 100);
    }
}

TEST(VulkanFrameSlots, waiting_for_a_slot_never_submitted_returns_at_once) {
    FrameSlots slots(gpu().device);
    EXPECT_FALSE(slots.pending(0));
    EXPECT_NO_THROW(slots.wait(0));
}

TEST(VulkanFrameSlots, a_slot_that_is_done_has_done_its_work) {
    Fills fills;
    FrameSlots slots(gpu().device);
    EXPECT_TRUE(slots.is_done(0)) << "never submitted";
    fills.word(0) = 0;
    slots.submit(0, fills.commands(0));
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!slots.is_done(0) && std::chrono::steady_clock::now() < last) std::this_thread::yield();
    ASSERT_TRUE(slots.is_done(0));
    EXPECT_EQ(fills.word(0), 100u);
    EXPECT_TRUE(slots.pending(0)) << "only wait() takes note";
    slots.wait(0);
    EXPECT_NO_THROW(slots.submit(0, fills.commands(0)));
}

TEST(VulkanFrameSlots, a_slot_in_flight_is_not_submitted_again) {
    Fills fills;
    FrameSlots slots(gpu().device);
    slots.submit(1, fills.commands(1));
    EXPECT_THROW(slots.submit(1, fills.commands(1)), vulkan::VulkanError);
    EXPECT_TRUE(slots.pending(1));
}

TEST(VulkanFrameSlots, destruction_waits_for_what_is_in_flight) {
    Fills fills;
    fills.word(0) = fills.word(1) = 0;
    {
        FrameSlots slots(gpu().device);
        slots.submit(0, fills.commands(0));
        slots.submit(1, fills.commands(1));
    }
    EXPECT_EQ(fills.word(0), 100u);
    EXPECT_EQ(fills.word(1), 101u);
}

}  // namespace drape::test
