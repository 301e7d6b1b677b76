#include "solver/kernel_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "cloth/cloth_state.h"
#include "cloth/kernel_steps.h"
#include "graph/executor.h"
#include "shared/line_types.h"
#include "shared/parts_types.h"
#include "shared/stream_types.h"
#include "shared/tile_types.h"
#include "vulkan/api.h"
#include "vulkan/error.h"

namespace drape {

namespace {

using Obstacle = std::string (*)(const vulkan::Device&, const SimulationModel&);

std::string sheet_obstacle(const vulkan::Device& device, glsl::ivec2 size) {
    constexpr std::uint32_t step = glsl::state_row_alignment / 16;
    const auto columns = static_cast<std::uint32_t>(size.x);
    return graph::buffer_view_obstacle(device,
                                       {.name = "the cloths' sheet",
                                        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                        .width = columns,
                                        .height = static_cast<std::uint32_t>(size.y)},
                                       (columns + step - 1) / step * step);
}

/// An image of a cloth's state; passes store to some through a buffer view (FieldView).
struct StateImage {
    VkFormat format;
    FieldExtent extent;
    bool is_stored;
};

/// Those that differ in what the device must be asked.
std::vector<StateImage> state_images(const Grid& grid) {
    const std::uint64_t width = grid.columns(), height = grid.rows();
    return {{VK_FORMAT_R32G32B32A32_SFLOAT, {width, height}, true},
            {VK_FORMAT_R32_SFLOAT, {width, height}, true},
            {VK_FORMAT_R32G32B32A32_SFLOAT, line_scratch_extent(grid), true},
            {VK_FORMAT_R32G32B32A32_SFLOAT, {1, 1}, false},
            {VK_FORMAT_R32_UINT, {width - 1, height - 1}, false},
            {VK_FORMAT_R32_UINT, {glsl::control_texel_count, 1}, false}};
}

/// The line control is counted up in an image.
bool has_linear_atomics(const vulkan::Device& device) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device.physical(), VK_FORMAT_R32_UINT, &properties);
    return properties.linearTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_ATOMIC_BIT;
}

/// Why the state cannot be stored through buffer views.
std::string store_obstacle(const vulkan::Device& device, const SimulationModel& model) {
    for (const ClothModel& cloth : model.cloths)
        if (const std::string obstacle = state_obstacle(device, cloth.grid, 1, true); !obstacle.empty())
            return fmt::format("cloth '{}': {}", cloth.name, obstacle);
    return model.self_contact ? sheet_obstacle(device, model.self_contact->push.grid) : std::string();
}

/// Why no subgroup can hand on what its lanes keep in registers.
std::string shuffle_obstacle(const vulkan::Device& device, const SimulationModel&) {
    constexpr auto lanes = static_cast<std::uint32_t>(glsl::stream_lanes);
    return device.capabilities().shuffles(lanes) ? std::string()
                                                 : fmt::format("the device has no subgroups of {} that shuffle", lanes);
}

/// Why no workgroup can hold a tile of so many particles a side.
template <int width>
std::string tile_obstacle(const vulkan::Device& device, const SimulationModel&) {
    constexpr std::uint32_t particles = width * width;
    constexpr std::uint32_t bytes = 2 * sizeof(glsl::vec4) * particles;  // two vectors each, the second padded
    const VkPhysicalDeviceLimits& limits = device.limits();
    if (limits.maxComputeWorkGroupInvocations < particles)
        return fmt::format("the device has no workgroups of {} invocations", particles);
    if (limits.maxComputeSharedMemorySize < bytes)
        return fmt::format("the device's workgroups share less than {} bytes", bytes);
    return {};
}

/// Workgroups are as large as the lines that they hold, and others are walked (cyclic_lines.h).
std::string no_obstacle(const vulkan::Device&, const SimulationModel&) { return {}; }

/// Why no workgroup can hold lines in parts, each of a full subgroup's.
std::string parts_obstacle(const vulkan::Device& device, const SimulationModel&) {
    constexpr std::uint32_t least = 4 * glsl::part_lines;
    const vulkan::DeviceCapabilities& has = device.capabilities();
    if (has.subgroup < least || !has.shuffles(has.subgroup))
        return fmt::format("the device has no subgroups of {} and more that shuffle", least);
    return has.full_subgroups ? std::string() : "the device does not promise full subgroups";
}

/// Returns the workgroups that kernels ask for, as far as a device has them.
GroupLimits group_limits(const vulkan::Device& device, const GroupLimits& asked) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    return {std::min({asked.invocations, limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]}),
            std::min(asked.shared_bytes, limits.maxComputeSharedMemorySize), device.capabilities().subgroup};
}

/// A kernel, the kind of device that it is the fastest on (`drape bench speed --tune` measures it), the kernel that it
/// needs as well, what the device must have, and why it is fast. On GPUs only the order of magnitude was measured.
struct KernelRule {
    Kernel kernel;
    DeviceKind best_on;
    Kernel needs;
    Obstacle obstacle;
    std::string_view why;
};
constexpr KernelRule rules[] = {
    {Kernel::buffer_store, DeviceKind::cpu, Kernel::plain, store_obstacle,
     "a CPU stores to buffers in .6 to .8 of the time that it takes to store to images"},
    {Kernel::explicit_stream, DeviceKind::cpu, Kernel::buffer_store, shuffle_obstacle,
     "a particle is loaded and stored once for four steps, and every spring is evaluated once"},
    {Kernel::explicit_tile, DeviceKind::gpu, Kernel::plain, tile_obstacle<glsl::explicit_tile_width>,
     "shared memory holds the particles for several steps"},
    {Kernel::spring_stream, DeviceKind::cpu, Kernel::buffer_store, shuffle_obstacle,
     "a particle is loaded and stored once instead of up to eight times"},
    {Kernel::spring_tile, DeviceKind::gpu, Kernel::plain, tile_obstacle<glsl::sweep_tile_width>,
     "shared memory holds the particles for all eight passes"},
    {Kernel::twist_stream, DeviceKind::cpu, Kernel::buffer_store, shuffle_obstacle,
     "a particle is loaded and stored once instead of four times"},
    {Kernel::twist_tile, DeviceKind::gpu, Kernel::plain, tile_obstacle<glsl::sweep_tile_width>,
     "shared memory holds the particles for all four passes"},
    {Kernel::line_parts, DeviceKind::gpu, Kernel::plain, parts_obstacle,
     "long lines are held in registers, several particles by an invocation"},
    {Kernel::line_cyclic, DeviceKind::gpu, Kernel::plain, no_obstacle,
     "a line waits for memory some log n times instead of 3 n times"},
};

const KernelRule& rule_of(Kernel kernel) { return *std::ranges::find(rules, kernel, &KernelRule::kernel); }

/// Why a kernel cannot run; empty where it can.
std::string obstacle_of(const vulkan::Device& device, const SimulationModel& model, const KernelRule& rule) {
    if (rule.needs != Kernel::plain)
        if (std::string obstacle = obstacle_of(device, model, rule_of(rule.needs)); !obstacle.empty()) return obstacle;
    return rule.obstacle(device, model);
}

}  // namespace

DeviceKind device_kind(const vulkan::DeviceInfo& device) {
    return device.type == "cpu" ? DeviceKind::cpu : DeviceKind::gpu;
}

std::string state_obstacle(const vulkan::Device& device, const Grid& grid, std::uint32_t count, bool buffered) {
    if (buffered && !device.capabilities().wide_integers) return "the device's shaders have no integers of 64 bits";
    std::vector<std::string> slices(count > 1 ? count : 0);
    if (count > 1) slices[1] = "slice of the state";  // where one may begin, all may
    for (const StateImage& image : state_images(grid)) {
        if (count == 1 && !image.is_stored) continue;
        const std::uint32_t step = glsl::state_row_alignment / vulkan::texel_size(image.format);
        const auto columns = static_cast<std::uint32_t>(image.extent.width),
                   rows = static_cast<std::uint32_t>(image.extent.height);
        std::string why = graph::buffer_view_obstacle(
            device,
            {.name = "state", .format = image.format, .width = columns, .height = rows * count, .slices = slices},
            buffered && image.is_stored ? (columns + step - 1) / step * step : 0);
        if (!why.empty()) return why;
    }
    return count > 1 && !has_linear_atomics(device) ? "the device has no atomics on LINEAR images" : std::string();
}

Kernels possible_kernels(const vulkan::Device& device, const SimulationModel& model, const Kernels& asked) {
    Kernels kernels;
    kernels.group = group_limits(device, asked.group);
    for (const KernelRule& rule : rules) {
        if (asked.is_automatic() ? rule.best_on != device_kind(device.info()) : !asked.has(rule.kernel)) continue;
        const std::string obstacle = obstacle_of(device, model, rule);
        if (obstacle.empty()) {
            kernels.add(rule.kernel);
            kernels.add(rule.needs);
        } else if (!asked.is_automatic()) {
            throw vulkan::VulkanError(fmt::format("kernel '{}', {}", name_of(rule.kernel), obstacle));
        }
    }
    return kernels;
}

Kernels used_kernels(const SimulationModel& model, const Kernels& kernels) {
    Kernels used;
    for (const Step& step : kernel_steps(model, kernels)) used.add(step.kernel);
    if (kernels.has(Kernel::buffer_store)) used.add(Kernel::buffer_store);
    return used;
}

bool concerns(const KernelSet& set, SolverMethod method) {
    return (set.name != "cyclic" && set.name != "parts") || method == SolverMethod::line;
}

std::vector<KernelVerdict> kernel_verdicts(const vulkan::Device& device, const SimulationModel& model,
                                           const Kernels& asked) {
    const Kernels taken = possible_kernels(device, model, asked), used = used_kernels(model, taken);
    std::vector<KernelVerdict> verdicts;
    for (const KernelRule& rule : rules) {
        std::string reason(rule.why);
        if (!used.has(rule.kernel)) {
            const std::string obstacle = obstacle_of(device, model, rule);
            reason = taken.has(rule.kernel)            ? "no step of this scene is its"
                     : !obstacle.empty()               ? obstacle
                     : !asked.is_automatic()           ? "not asked for"
                     : rule.best_on == DeviceKind::cpu ? "best on a CPU"
                                                       : "best on a GPU";
        }
        verdicts.push_back({rule.kernel, used.has(rule.kernel), reason});
    }
    return verdicts;
}

}  // namespace drape
