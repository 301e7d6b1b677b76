#include "vulkan/frame_slots.h"

#include <fmt/format.h>

#include "vulkan/api.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

FrameSlots::FrameSlots(const Device& device, Empty) : device_(device) {}

FrameSlots::FrameSlots(const Device& device) : FrameSlots(device, Empty{}) {
    const auto info = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    for (VkFence& fence : fences_) {
        create_handle(vkCreateFence, device.handle(), info, fence, "vkCreateFence", "frame slot");
        device.set_name(VK_OBJECT_TYPE_FENCE, reinterpret_cast<std::uint64_t>(fence), "frame slot");
    }
}

FrameSlots::~FrameSlots() {
    for (std::uint32_t slot = 0; slot < frame_slot_count; ++slot) {
        try {
            wait(slot);
        } catch (const VulkanError&) {
            // The wait for the fence failed. Once the queue is idle the fence can be destroyed safely; for a lost
            // device, the usual reason, this returns at once.
            let_finish(device_.handle());
        }
    }
    for (VkFence fence : fences_) vkDestroyFence(device_.handle(), fence, nullptr);
}

void FrameSlots::wait(std::uint32_t slot) {
    if (!pending_[slot]) return;
    device_.wait(fences_[slot], fmt::format("frame slot {}", slot));
    pending_[slot] = false;
}

bool FrameSlots::is_done(std::uint32_t slot) const {
    if (!pending_[slot]) return true;
    const VkResult status = vkGetFenceStatus(device_.handle(), fences_[slot]);
    if (status != VK_NOT_READY) check(status, "vkGetFenceStatus", fmt::format("frame slot {}", slot));
    return status == VK_SUCCESS;
}

void FrameSlots::submit(std::uint32_t slot, std::span<const VkCommandBuffer> commands) {
    const std::string object = fmt::format("frame slot {}", slot);
    if (pending_[slot]) throw VulkanError(object + " was submitted again before it was waited for");
    check(vkResetFences(device_.handle(), 1, &fences_[slot]), "vkResetFences", object);
    device_.submit(commands, fences_[slot], object);
    pending_[slot] = true;
}

}  // namespace drape::vulkan
