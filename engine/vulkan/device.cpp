#include "vulkan/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <vector>

#include "vulkan/api.h"
#include "vulkan/device_requirements.h"
#include "vulkan/device_selection.h"
#include "vulkan/pipeline.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

/// A slice is long enough to cost nothing, and so short that a lost device is noticed and a debugger can break in.
constexpr std::uint64_t wait_slice_nanoseconds = 1'000'000'000;

/// Returns the bytes that the system could give now; the maximum where it does not say.
std::uint64_t available_memory() {
    std::ifstream file("/proc/meminfo");
    std::string key, unit;
    std::uint64_t kibibytes = 0;
    while (file >> key >> kibibytes && std::getline(file, unit)) {
        if (key == "MemAvailable:") return kibibytes * 1024;
    }
    return std::numeric_limits<std::uint64_t>::max();
}

/// A fence and a command buffer are freed in every case, the queue being idle then.
struct OnceCommands {
    const Device& device;
    VkCommandPool pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool in_flight = false;

    OnceCommands(const Device& owner, VkCommandPool command_pool) : device(owner), pool(command_pool) {}
    OnceCommands(const OnceCommands&) = delete;
    OnceCommands& operator=(const OnceCommands&) = delete;
    ~OnceCommands() {
        if (in_flight) let_finish(device.handle());
        if (commands) vkFreeCommandBuffers(device.handle(), pool, 1, &commands);
        vkDestroyFence(device.handle(), fence, nullptr);
    }
};

}  // namespace

std::uint64_t memory_budget_limit(const VkPhysicalDeviceMemoryProperties& memory, bool cpu) {
    std::uint64_t heap = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
            heap = std::max<std::uint64_t>(heap, memory.memoryHeaps[i].size);
        }
    }
    // The division comes first, so that no size can wrap.
    const std::uint64_t limit = heap / 10 * 9;
    return cpu ? std::min(limit, available_memory() / 4 * 3) : limit;
}

Device::Device(const Instance& instance, DeviceInfo info, Empty) : instance_(instance), info_(std::move(info)) {}

namespace {

DeviceInfo selected(const Instance& instance, std::string_view selector) {
    constexpr const char* variable = "DRAPE_DEVICE";
    const char* preferred = selector.empty() ? std::getenv(variable) : nullptr;
    if (!preferred) return select_device(instance.devices(), selector);
    try {
        return select_device(instance.devices(), preferred);
    } catch (const VulkanError& error) {
        throw VulkanError(fmt::format("{}: {}", variable, error.what()));
    }
}

}  // namespace

Device::Device(const Instance& instance, std::string_view selector, std::span<const std::string_view> without)
    : Device(instance, selected(instance, selector), Empty{}) {
    physical_ = instance.physical_device(info_.index);
    read_capabilities(without);
    create();
    vkGetDeviceQueue(handle_, queue_family_, 0, &queue_);
    auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queue_family_;
    create_handle(vkCreateCommandPool, handle_, pool, once_pool_, "vkCreateCommandPool", "set-up");
    if (instance.validation()) {
        // volk's own pointer belongs to the instance made last, which may lack the extension.
        set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            vkGetInstanceProcAddr(instance.handle(), "vkSetDebugUtilsObjectNameEXT"));
    }
    set_name(VK_OBJECT_TYPE_COMMAND_POOL, reinterpret_cast<std::uint64_t>(once_pool_), "set-up");
}

void Device::read_capabilities(std::span<const std::string_view> without) {
    const DeviceFacts facts(physical_);
    for (const std::string_view key : without) info_.lacks.emplace_back(optional_requirement(key).key);
    const auto has = [this](std::string_view key) { return std::ranges::find(info_.lacks, key) == info_.lacks.end(); };
    capabilities_.limits = facts.properties.limits;
    capabilities_.max_buffer_size = facts.properties13.maxBufferSize;
    capabilities_.max_allocation_size = facts.properties11.maxMemoryAllocationSize;
    capabilities_.push_descriptors = has("push_descriptors");
    capabilities_.max_push_descriptors = facts.max_push_descriptors;
    capabilities_.texel_buffers = has("texel_buffers");
    capabilities_.most_texels = capabilities_.texel_buffers ? limits().maxTexelBufferElements
                                                            : limits().maxStorageBufferRange / (4 * sizeof(float));
    capabilities_.subgroup = facts.properties11.subgroupSize;
    capabilities_.shuffling_lanes = has("shuffles") ? facts.shuffling_lanes() : 0;
    capabilities_.full_subgroups = has("full_subgroups");
    capabilities_.wide_integers = has("wide_integers");
    capabilities_.wide_atomics = has("wide_integers") && has("wide_atomics");
    capabilities_.samples_in_shaders = has("samples_in_shaders");
    capabilities_.timestamp_valid_bits = has("timestamps") ? facts.timestamp_valid_bits : 0;
    // What it only seems to lack is as small as Vulkan allows.
    const auto pretends = [&](std::string_view key) { return !has(key) && optional_requirement(key).has(facts); };
    if (pretends("shared_memory")) {
        capabilities_.limits.maxComputeSharedMemorySize = 16384;
        capabilities_.limits.maxComputeWorkGroupInvocations = 128;
    }
    if (pretends("storage_images")) capabilities_.limits.maxPerStageDescriptorStorageImages = 4;
    if (pretends("storage_buffers")) capabilities_.limits.maxPerStageDescriptorStorageBuffers = 4;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
    budget_ = MemoryBudget(memory_budget_limit(memory_, facts.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU));
    queue_family_ = facts.queue_family.value();  // a usable device has one
}

void Device::create() {
    auto features12 =
        structure<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
    features12.shaderBufferInt64Atomics = capabilities_.wide_atomics ? VK_TRUE : VK_FALSE;
    auto features13 =
        structure<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    features13.synchronization2 = VK_TRUE;
    features13.dynamicRendering = VK_TRUE;
    features13.maintenance4 = VK_TRUE;
    features13.computeFullSubgroups = capabilities_.full_subgroups ? VK_TRUE : VK_FALSE;
    features13.pNext = &features12;
    VkPhysicalDeviceFeatures features{};
    features.shaderClipDistance = VK_TRUE;
    features.shaderInt64 = capabilities_.wide_integers ? VK_TRUE : VK_FALSE;
    features.shaderStorageImageMultisample = capabilities_.samples_in_shaders ? VK_TRUE : VK_FALSE;
    // As a load beyond a texel buffer does, one beyond a storage buffer then harms nothing. Every device has it.
    features.robustBufferAccess = capabilities_.texel_buffers ? VK_FALSE : VK_TRUE;
    constexpr float priority = 1.0f;
    auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    constexpr const char* extensions[] = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
    auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &features13;
    info.pEnabledFeatures = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = capabilities_.push_descriptors ? 1 : 0;
    info.ppEnabledExtensionNames = extensions;
    const VkResult result = vkCreateDevice(physical_, &info, nullptr, &handle_);
    if (result != VK_SUCCESS) handle_ = VK_NULL_HANDLE;
    check(result, "vkCreateDevice", info_.name);
}

Device::~Device() {
    if (!handle_) return;
    let_finish(handle_);
    pipelines_.made.clear();
    vkDestroyCommandPool(handle_, once_pool_, nullptr);
    vkDestroyDevice(handle_, nullptr);
}

const ComputePipeline& Device::compute_pipeline(const std::string& module,
                                                std::span<const SpecializationConstant> constants) const {
    std::string key = module;
    for (const SpecializationConstant& constant : constants)
        key += fmt::format(" {}={}", constant.name, constant.value);
    const std::scoped_lock lock(pipelines_.guard);
    std::unique_ptr<ComputePipeline>& pipeline = pipelines_.made[key];
    if (!pipeline) pipeline = std::make_unique<ComputePipeline>(*this, key, Shader{module}, constants);
    return *pipeline;
}

std::uint32_t Device::memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred) const {
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const bool allowed = (type_bits >> i) & 1u;
            if (allowed && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
        }
    }
    throw VulkanError(fmt::format("{} has no memory type with the properties {:#x} among the types {:#x}", info_.name,
                                  required, type_bits));
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                                VkMemoryPropertyFlags preferred, std::string_view object) const {
    if (requirements.size > capabilities_.max_allocation_size) {
        throw VulkanError(fmt::format("{} needs {} bytes of memory, one allocation may have {}", object,
                                      requirements.size, capabilities_.max_allocation_size));
    }
    auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = memory_type(requirements.memoryTypeBits, required, preferred);
    budget_.reserve(requirements.size, object);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    try {
        create_handle(vkAllocateMemory, handle_, info, memory, "vkAllocateMemory", object);
    } catch (const VulkanError&) {
        budget_.release(requirements.size);
        throw;
    }
    return memory;
}

void Device::free(VkDeviceMemory memory, std::uint64_t bytes) const {
    if (!memory) return;
    vkFreeMemory(handle_, memory, nullptr);
    budget_.release(bytes);
}

void Device::wait_idle() const { check(vkDeviceWaitIdle(handle_), "vkDeviceWaitIdle"); }

void Device::wait(VkFence fence, std::string_view object) const {
    VkResult result = VK_TIMEOUT;
    while (result == VK_TIMEOUT) {
        result = vkWaitForFences(handle_, 1, &fence, VK_TRUE, wait_slice_nanoseconds);
    }
    check(result, "vkWaitForFences", object);
}

void Device::submit(std::span<const VkCommandBuffer> commands, VkFence fence, std::string_view object) const {
    std::vector<VkCommandBufferSubmitInfo> buffers;
    for (const VkCommandBuffer each : commands) {
        buffers.push_back(structure<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO));
        buffers.back().commandBuffer = each;
    }
    auto info = structure<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
    info.commandBufferInfoCount = static_cast<std::uint32_t>(buffers.size());
    info.pCommandBufferInfos = buffers.data();
    check(vkQueueSubmit2(queue_, 1, &info, fence), "vkQueueSubmit2", object);
}

void Device::run_once(const std::function<void(VkCommandBuffer)>& record) const {
    OnceCommands once(*this, once_pool_);
    auto fence = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    create_handle(vkCreateFence, handle_, fence, once.fence, "vkCreateFence", "set-up");
    auto allocation = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = once_pool_;
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(handle_, &allocation, &commands), "vkAllocateCommandBuffers", "set-up");
    once.commands = commands;
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer", "set-up");
    record(commands);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer", "set-up");
    submit(std::span(&commands, 1), once.fence, "set-up");
    once.in_flight = true;
    wait(once.fence, "set-up");
    once.in_flight = false;
}

void Device::set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!set_name_) return;
    auto info = structure<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    check(set_name_(handle_, &info), "vkSetDebugUtilsObjectNameEXT", name);
}

}  // namespace drape::vulkan
