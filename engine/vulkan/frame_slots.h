// Up to two frames are in flight, with a fence each and one queue, without timeline semaphores (docs/devices.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "vulkan/device.h"

namespace drape::vulkan {

inline constexpr std::uint32_t frame_slot_count = 2;

/// Slot k may be submitted again only after `wait(k)`. The destructor waits for all slots.
class FrameSlots {
  public:
    explicit FrameSlots(const Device& device);
    ~FrameSlots();
    FrameSlots(const FrameSlots&) = delete;
    FrameSlots& operator=(const FrameSlots&) = delete;

    /// Blocks until the last submit of the slot has finished (at once when there was none). Throws VulkanError on
    /// device loss.
    void wait(std::uint32_t slot);
    /// Returns whether `wait` would return at once. Throws as `wait` does.
    bool is_done(std::uint32_t slot) const;
    /// Throws VulkanError when the slot's last submit was not waited for.
    void submit(std::uint32_t slot, std::span<const VkCommandBuffer> commands);
    void submit(std::uint32_t slot, VkCommandBuffer commands) { submit(slot, std::span(&commands, 1)); }
    bool pending(std::uint32_t slot) const { return pending_[slot]; }

  private:
    struct Empty {};
    FrameSlots(const Device& device, Empty);

    const Device& device_;
    std::array<VkFence, frame_slot_count> fences_{};
    std::array<bool, frame_slot_count> pending_{};
};

}  // namespace drape::vulkan
