// Devices are found, wrong selectors refused, and the memory budget kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>

#include "gpu_test.h"
#include "vulkan/api.h"
#include "vulkan/device_requirements.h"
#include "vulkan/device_selection.h"
#include "vulkan/pipeline.h"
#include "vulkan/resources.h"
#include "vulkan_error.h"

namespace drape::test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using vulkan::DeviceInfo;
using vulkan::select_device;
using vulkan::VulkanError;

namespace {

class Environment {
  public:
    Environment(std::string name, const char* value) : name_(std::move(name)) {
        if (const char* old = std::getenv(name_.c_str())) old_ = old;
        setenv(name_.c_str(), value, 1);
    }
    ~Environment() { old_ ? setenv(name_.c_str(), old_->c_str(), 1) : unsetenv(name_.c_str()); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    std::string name_;
    std::optional<std::string> old_;
};

DeviceInfo device(std::uint32_t index, std::string name, std::string type, std::string unusable = {}) {
    DeviceInfo info;
    info.index = index;
    info.name = std::move(name);
    info.type = std::move(type);
    info.uuid[0] = static_cast<std::uint8_t>(0xa0 + index);
    info.usable = unusable.empty();
    info.unusable_reason = std::move(unusable);
    return info;
}

const std::vector<DeviceInfo> machine = {
    device(0, "llvmpipe (LLVM)", "cpu"), device(1, "Ancient GPU", "discrete", "Vulkan 1.3 is needed"),
    device(2, "Small GPU", "integrated"), device(3, "Big GPU", "discrete"), device(4, "Big GPU Plus", "discrete")};

}  // namespace

TEST(VulkanDevice, what_it_lacks_is_documented_and_named) {
    std::ifstream file(DRAPE_SOURCE_DIR "/engine/docs/devices.md");
    const std::string document{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(document, HasSubstr("\n\n" + vulkan::device_requirements_document() + "\n"))
        << "build/drape devices --needs";
    const Environment without("DRAPE_WITHOUT", "texel_buffers,push_descriptors");
    const vulkan::Instance instance({});
    const vulkan::Device device(instance, "cpu");
    EXPECT_THAT(device.info().lacks, testing::IsSupersetOf({"texel_buffers", "push_descriptors"}));
    EXPECT_FALSE(device.capabilities().push_descriptors || device.capabilities().texel_buffers);
}

TEST(VulkanDevice, what_no_device_may_lack_is_refused) {
    for (const char* key : {"synchronization2", "textures", "wide_atomics,"}) {
        const Environment without("DRAPE_WITHOUT", key);
        if (std::string_view(key).ends_with(',')) {
            EXPECT_NO_THROW(vulkan::Instance({})) << key;
            continue;
        }
        EXPECT_THAT([] { vulkan::Instance instance({}); },
                    testing::ThrowsMessage<VulkanError>(HasSubstr("is nothing that a device may lack")));
    }
}

/// A pass beyond the device's descriptors is refused by name, before anything is made of it.
TEST(VulkanDevice, a_pipeline_of_more_descriptors_than_a_stage_has_is_refused) {
    const std::string_view without[] = {"storage_images", "storage_buffers"};
    const vulkan::Device small(gpu().instance, gpu().device.info().uuid_text(), without);
    EXPECT_THAT([&] { small.compute_pipeline("predict.comp"); },
                testing::ThrowsMessage<VulkanError>(AllOf(HasSubstr("predict.comp"), HasSubstr("limit is 4"))));
}

TEST(VulkanDeviceSelection, prefers_a_gpu_of_the_best_type_that_can_be_used) {
    EXPECT_EQ(select_device(machine, "").index, 3u);
    EXPECT_EQ(select_device(std::span(machine).first(3), "").index, 2u);
    EXPECT_EQ(select_device(std::span(machine).first(2), "").index, 0u);
}

TEST(VulkanDeviceSelection, understands_cpu_index_uuid_and_name) {
    EXPECT_EQ(select_device(machine, "cpu").index, 0u);
    EXPECT_EQ(select_device(machine, "2").index, 2u);
    EXPECT_EQ(select_device(machine, "a4000000-0000-0000-0000-000000000000").index, 4u);
    EXPECT_EQ(select_device(machine, "A4000000000000000000000000000000").index, 4u);
    EXPECT_EQ(select_device(machine, "SMALL").index, 2u);
    EXPECT_EQ(select_device(machine, "big gpu").index, 3u) << "the whole name beats a part of two names";
}

TEST(VulkanDeviceSelection, refuses_what_is_unknown_ambiguous_or_unusable) {
    EXPECT_THAT(error_of([] { select_device(machine, "voodoo"); }),
                AllOf(HasSubstr("no device matches \"voodoo\""), HasSubstr("2: Small GPU"), HasSubstr("Ancient GPU"),
                      HasSubstr("cannot be used: Vulkan 1.3 is needed")));
    EXPECT_THAT(error_of([] { select_device(machine, "big"); }), HasSubstr("ambiguous (2 devices match)"));
    EXPECT_THAT(error_of([] { select_device(machine, "5"); }), HasSubstr("there is no device 5"));
    EXPECT_THAT(error_of([] { select_device(machine, "99999999999999999999"); }), HasSubstr("there is no device 9"));
    EXPECT_THAT(error_of([] { select_device(machine, "1"); }),
                HasSubstr("device 1 (Ancient GPU) cannot be used: Vulkan 1.3 is needed"));
    EXPECT_THAT(error_of([] { select_device(std::span(machine).subspan(2), "cpu"); }),
                HasSubstr("no usable CPU device"));
    EXPECT_THAT(error_of([] { select_device(std::span(machine).subspan(1, 1), ""); }),
                HasSubstr("no usable Vulkan device"));
    EXPECT_EQ(error_of([] { select_device({}, ""); }), "no Vulkan device found");
}

TEST(VulkanDevice, lists_every_device_with_its_identity) {
    const auto devices = gpu().instance.devices();
    ASSERT_FALSE(devices.empty());
    for (std::uint32_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].index, i);
        EXPECT_FALSE(devices[i].name.empty());
        EXPECT_FALSE(devices[i].driver.empty());
        EXPECT_FALSE(devices[i].driver_version.empty());
        EXPECT_EQ(devices[i].uuid_text().size(), 36u);
        EXPECT_EQ(devices[i].usable, devices[i].unusable_reason.empty());
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(gpu().instance.physical_device(i), &properties);
        EXPECT_EQ(devices[i].name, properties.deviceName);
    }
}

TEST(VulkanDevice, can_be_named_by_index_uuid_and_name) {
    const DeviceInfo wanted = gpu().device.info();
    for (const std::string& selector : {std::to_string(wanted.index), wanted.uuid_text()}) {
        const vulkan::Device same(gpu().instance, selector);
        EXPECT_EQ(same.info().index, wanted.index) << selector;
        EXPECT_NE(same.handle(), gpu().device.handle());
    }
}

TEST(VulkanDevice, is_what_the_environment_says_where_no_selector_is_given) {
    const DeviceInfo wanted = gpu().device.info();
    {
        const Environment index("DRAPE_DEVICE", std::to_string(wanted.index).c_str());
        EXPECT_EQ(vulkan::Device(gpu().instance, "").info().index, wanted.index);
    }
    const Environment nonsense("DRAPE_DEVICE", "no such device");
    EXPECT_EQ(vulkan::Device(gpu().instance, wanted.uuid_text()).info().index, wanted.index);
    EXPECT_THAT(error_of([] { vulkan::Device(gpu().instance, ""); }),
                AllOf(HasSubstr("DRAPE_DEVICE: no device matches \"no such device\""), HasSubstr(wanted.name)));
}

TEST(VulkanDevice, an_unknown_selector_lists_the_devices) {
    const std::string error = error_of([] { vulkan::Device(gpu().instance, "no such device"); });
    EXPECT_THAT(error, HasSubstr("no device matches \"no such device\""));
    for (const DeviceInfo& info : gpu().instance.devices()) EXPECT_THAT(error, HasSubstr(info.name));
}

TEST(VulkanDevice, lives_beside_devices_without_validation) {
    const vulkan::Device& validated = gpu().device;
    const vulkan::Instance plain_instance({.validation = false});
    EXPECT_FALSE(plain_instance.validation());
    const vulkan::Device plain(plain_instance, validated.info().uuid_text());
    for (const vulkan::Device* device : {&plain, &validated, &plain}) {
        const vulkan::Buffer buffer(*device,
                                    {.name = "pair",
                                     .byte_count = 8,
                                     .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
        const std::array<std::uint32_t, 2> sent = {1, 2};
        std::array<std::uint32_t, 2> received{};
        upload(*device, buffer, std::as_bytes(std::span(sent)));
        download(*device, buffer, std::as_writable_bytes(std::span(received)));
        EXPECT_EQ(sent, received);
    }
}

TEST(VulkanInstance, without_a_driver_says_so) {
    const Environment files("VK_ICD_FILENAMES", "/nonexistent.json"), newer("VK_DRIVER_FILES", "/nonexistent.json");
    EXPECT_THAT(error_of([] { vulkan::Instance({.validation = false}); }),
                HasSubstr("vkCreateInstance(no Vulkan driver found): VK_ERROR_INCOMPATIBLE_DRIVER"));
}

TEST(VulkanInstance, without_the_validation_layer_does_not_run_on) {
    const Environment path("VK_LAYER_PATH", "/nonexistent");
    EXPECT_THAT(error_of([] { vulkan::Instance({.validation = true}); }),
                HasSubstr("VK_LAYER_KHRONOS_validation is not installed"));
}

TEST(VulkanValidationLog, counts_all_and_keeps_the_first) {
    vulkan::ValidationLog log;
    const std::size_t kept = vulkan::ValidationLog::kept_message_count;
    for (std::size_t i = 0; i < kept + 5; ++i) log.add("VUID-x", "text " + std::to_string(i));
    EXPECT_EQ(log.count(), kept + 5);
    ASSERT_EQ(log.messages().size(), kept);
    EXPECT_EQ(log.messages().front(), "VUID-x: text 0");
    log.clear();
    EXPECT_EQ(log.count(), 0u);
    EXPECT_TRUE(log.messages().empty());
}

TEST(VulkanError, names_call_object_and_result) {
    const VulkanError error(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2", "frame slot 1");
    EXPECT_STREQ(error.what(), "vkQueueSubmit2(frame slot 1): VK_ERROR_DEVICE_LOST");
    EXPECT_EQ(error.result(), VK_ERROR_DEVICE_LOST);
    EXPECT_STREQ(VulkanError(VK_TIMEOUT, "vkWaitForFences").what(), "vkWaitForFences: VK_TIMEOUT");
    EXPECT_STREQ(VulkanError(static_cast<VkResult>(-4711), "vkX").what(), "vkX: VkResult -4711");
    EXPECT_NO_THROW(vulkan::check(VK_SUCCESS, "vkX"));
    EXPECT_THROW(vulkan::check(VK_INCOMPLETE, "vkX"), VulkanError);
}

TEST(VulkanMemoryBudget, refuses_what_does_not_fit_and_keeps_its_count) {
    vulkan::MemoryBudget budget(100);
    budget.reserve(60, "first");
    EXPECT_NO_THROW(budget.require(40, "exact"));
    EXPECT_THAT(
        error_of([&] { budget.reserve(41, "image banner/position"); }),
        AllOf(HasSubstr("image banner/position needs 41 bytes"), HasSubstr("40 bytes"), HasSubstr("100 bytes")));
    EXPECT_THROW(budget.require(std::numeric_limits<std::uint64_t>::max(), "wraps"), VulkanError);
    EXPECT_EQ(budget.used(), 60u);
    budget.release(60);
    EXPECT_NO_THROW(budget.reserve(100, "all"));
}

TEST(VulkanMemoryBudget, is_nine_tenths_of_the_largest_device_local_heap) {
    VkPhysicalDeviceMemoryProperties memory{};
    memory.memoryHeapCount = 3;
    memory.memoryHeaps[0] = {50'000, 0};
    memory.memoryHeaps[1] = {10'000, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    memory.memoryHeaps[2] = {2'000, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    EXPECT_EQ(vulkan::memory_budget_limit(memory, false), 9'000u);
    memory.memoryHeaps[1].size = std::numeric_limits<std::uint64_t>::max();
    EXPECT_GT(vulkan::memory_budget_limit(memory, false), std::uint64_t{1} << 63);
    // A CPU device's heap is the machine's memory, and no machine has 16 EiB.
    EXPECT_LT(vulkan::memory_budget_limit(memory, true), std::uint64_t{1} << 60);
}

}  // namespace drape::test
