// Each Vulkan call that makes something is failed once: the error names it, the budget is whole again, and nothing is
// left over (the validation layer would name it at the end of the process).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <type_traits>

#include "gpu_test.h"
#include "vulkan/api.h"
#include "vulkan/frame_slots.h"
#include "vulkan/pipeline.h"
#include "vulkan/resources.h"

// The attribute that lets nobody ignore a result code is no part of a function's type.
#pragma GCC diagnostic ignored "-Wignored-attributes"

namespace drape::test {

using testing::HasSubstr;
using vulkan::VulkanError;

namespace {

/// While it lives, the call numbered `skipped` from now through volk's pointer `slot` fails with `result` and
/// leaves garbage in its output, as Vulkan allows.
template <auto* slot, class Function = std::remove_reference_t<decltype(*slot)>>
class Fault;

template <auto* slot, class... Arguments>
class Fault<slot, VkResult (*)(Arguments...)> {
  public:
    explicit Fault(VkResult result, int skipped = 0) {
        gpu();  // volk knows the pointers once an instance was made
        original_ = *slot;
        result_ = result;
        skipped_ = skipped;
        *slot = call;
    }
    ~Fault() {
        *slot = original_;
        EXPECT_LT(skipped_, 0) << "the call that should have failed was never made";
    }
    Fault(const Fault&) = delete;
    Fault& operator=(const Fault&) = delete;

  private:
    static VkResult call(Arguments... arguments) {
        if (skipped_-- != 0) return original_(arguments...);
        using Last = std::tuple_element_t<sizeof...(Arguments) - 1, std::tuple<Arguments...>>;
        if constexpr (std::is_pointer_v<Last> && std::is_pointer_v<std::remove_pointer_t<Last>>) {
            *std::get<sizeof...(Arguments) - 1>(std::tie(arguments...)) =
                reinterpret_cast<std::remove_pointer_t<Last>>(0xdead);
        }
        return result_;
    }
    static inline VkResult (*original_)(Arguments...);
    static inline VkResult result_;
    static inline int skipped_;
};

/// Returns the error of `make` while `slot` fails.
template <auto* slot, class Function>
std::string error_with(VkResult result, Function make, int skipped = 0) {
    const std::uint64_t used = gpu().device.budget().used();
    std::string text = "no VulkanError";
    {
        const Fault<slot> fault(result, skipped);
        try {
            make();
        } catch (const VulkanError& error) {
            text = error.what();
            EXPECT_EQ(error.result(), result);
        }
    }
    EXPECT_EQ(gpu().device.budget().used(), used) << text;
    make();  // and without the fault it works
    return text;
}

constexpr VkResult no_memory = VK_ERROR_OUT_OF_DEVICE_MEMORY;

}  // namespace

TEST(VulkanFaults, an_image_is_whole_or_not_at_all) {
    const auto make = [] { vulkan::Image(gpu().device, {.name = "flag/normal", .usage = VK_IMAGE_USAGE_STORAGE_BIT}); };
    EXPECT_EQ(error_with<&vkCreateImage>(no_memory, make), "vkCreateImage(flag/normal): VK_ERROR_OUT_OF_DEVICE_MEMORY");
    EXPECT_THAT(error_with<&vkAllocateMemory>(no_memory, make), HasSubstr("vkAllocateMemory(image flag/normal)"));
    EXPECT_THAT(error_with<&vkBindImageMemory>(no_memory, make), HasSubstr("vkBindImageMemory(flag/normal)"));
    EXPECT_THAT(error_with<&vkCreateImageView>(no_memory, make), HasSubstr("vkCreateImageView(flag/normal)"));
    EXPECT_THAT(error_with<&vkGetPhysicalDeviceImageFormatProperties>(VK_ERROR_OUT_OF_HOST_MEMORY, make),
                HasSubstr("vkGetPhysicalDeviceImageFormatProperties(flag/normal)"));
}

TEST(VulkanFaults, a_buffer_is_whole_or_not_at_all) {
    const auto make = [] {
        vulkan::Buffer(gpu().device, {"pins", 64, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, vulkan::BufferHome::upload});
    };
    EXPECT_THAT(error_with<&vkCreateBuffer>(no_memory, make), HasSubstr("vkCreateBuffer(pins)"));
    EXPECT_THAT(error_with<&vkAllocateMemory>(no_memory, make), HasSubstr("vkAllocateMemory(buffer pins)"));
    EXPECT_THAT(error_with<&vkBindBufferMemory>(no_memory, make), HasSubstr("vkBindBufferMemory(pins)"));
    EXPECT_THAT(error_with<&vkMapMemory>(VK_ERROR_MEMORY_MAP_FAILED, make), HasSubstr("vkMapMemory(pins)"));
}

TEST(VulkanFaults, a_compute_pipeline_is_whole_or_not_at_all) {
    const auto make = [&] { vulkan::ComputePipeline(gpu().device, "copy", {"canary.comp"}, {}); };
    EXPECT_THAT(error_with<&vkCreateShaderModule>(no_memory, make), HasSubstr("vkCreateShaderModule(canary.comp)"));
    EXPECT_THAT(error_with<&vkCreateDescriptorSetLayout>(no_memory, make), HasSubstr("(copy)"));
    EXPECT_THAT(error_with<&vkCreatePipelineLayout>(no_memory, make), HasSubstr("vkCreatePipelineLayout(copy)"));
    EXPECT_THAT(error_with<&vkCreateComputePipelines>(no_memory, make), HasSubstr("vkCreateComputePipelines(copy)"));
}

TEST(VulkanFaults, a_graphics_pipeline_is_whole_or_not_at_all) {
    vulkan::GraphicsState state;
    state.vertex = {"triangle.vert", test_shader("triangle.vert")};
    state.fragment = {"triangle.frag", test_shader("triangle.frag")};
    const auto make = [&] { vulkan::GraphicsPipeline(gpu().device, "cloth", state); };
    EXPECT_THAT(error_with<&vkCreateShaderModule>(no_memory, make), HasSubstr("vkCreateShaderModule(triangle.vert)"));
    EXPECT_THAT(error_with<&vkCreateShaderModule>(no_memory, make, 1), HasSubstr("(triangle.frag)"));
    EXPECT_THAT(error_with<&vkCreateGraphicsPipelines>(no_memory, make), HasSubstr("vkCreateGraphicsPipelines(cloth)"));
}

TEST(VulkanFaults, frame_slots_are_whole_or_not_at_all) {
    const auto make = [] { vulkan::FrameSlots slots(gpu().device); };
    EXPECT_THAT(error_with<&vkCreateFence>(no_memory, make), HasSubstr("vkCreateFence(frame slot)"));
    EXPECT_THAT(error_with<&vkCreateFence>(no_memory, make, 1), HasSubstr("vkCreateFence(frame slot)"));
}

TEST(VulkanFaults, a_device_and_an_instance_are_whole_or_not_at_all) {
    const auto make_device = [] { vulkan::Device(gpu().instance, gpu().device.info().uuid_text()); };
    EXPECT_THAT(error_with<&vkCreateDevice>(VK_ERROR_INITIALIZATION_FAILED, make_device), HasSubstr("vkCreateDevice"));
    EXPECT_THAT(error_with<&vkCreateCommandPool>(no_memory, make_device), HasSubstr("vkCreateCommandPool"));
    const auto make_instance = [] { vulkan::Instance({.validation = true}); };
    EXPECT_THAT(error_with<&vkCreateInstance>(VK_ERROR_OUT_OF_HOST_MEMORY, make_instance),
                HasSubstr("vkCreateInstance"));
}

TEST(VulkanFaults, run_once_reports_each_failing_call_and_leaves_the_queue_usable) {
    const auto run = [] { gpu().device.run_once([](VkCommandBuffer) {}); };
    EXPECT_THAT(error_with<&vkCreateFence>(no_memory, run), HasSubstr("vkCreateFence"));
    EXPECT_THAT(error_with<&vkAllocateCommandBuffers>(no_memory, run), HasSubstr("vkAllocateCommandBuffers"));
    EXPECT_THAT(error_with<&vkBeginCommandBuffer>(no_memory, run), HasSubstr("vkBeginCommandBuffer"));
    EXPECT_THAT(error_with<&vkEndCommandBuffer>(no_memory, run), HasSubstr("vkEndCommandBuffer"));
    EXPECT_THAT(error_with<&vkQueueSubmit2>(VK_ERROR_DEVICE_LOST, run), HasSubstr("vkQueueSubmit2"));
    EXPECT_THAT(error_with<&vkWaitForFences>(VK_ERROR_DEVICE_LOST, run),
                HasSubstr("vkWaitForFences(set-up): VK_ERROR_DEVICE_LOST"));
}

TEST(VulkanFaults, a_slow_fence_is_waited_for_again) {
    // VK_TIMEOUT means that one slice passed, not that the wait failed.
    const Fault<&vkWaitForFences> fault(VK_TIMEOUT);
    EXPECT_NO_THROW(gpu().device.run_once([](VkCommandBuffer) {}));
}

}  // namespace drape::test
