// The choice of kernels (drape/kernels.h) that a device takes for a model, and the reasons.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cloth/simulation_model.h"
#include "vulkan/device.h"

namespace drape {

/// Returns what method `auto` has to know of a device.
DeviceKind device_kind(const vulkan::DeviceInfo& device);

/// Returns the kernels asked for, with those that they need; automatic: those that suit the device and model. Throws
/// VulkanError, naming the kernel, where the device has not what one needs.
Kernels possible_kernels(const vulkan::Device& device, const SimulationModel& model, const Kernels& asked);

/// Returns those of the kernels that some step of a frame uses.
Kernels used_kernels(const SimulationModel& model, const Kernels& kernels);

/// Kernels that belong together, for tests and benchmarks that compare them.
struct KernelSet {
    std::string_view name;
    Kernels kernels;
};
inline const KernelSet all_kernel_sets[] = {
    {"plain", {}},
    {"buffer_store", {Kernel::buffer_store}},
    {"stream", stream_kernels},
    {"tile", tile_kernels},
    {"cyclic", cyclic_kernels},
    {"parts", parts_kernels},
};
/// Returns whether a method, not `automatic`, may have a step that such kernels do.
bool concerns(const KernelSet& set, SolverMethod method);

/// A kernel and whether a model's steps use it on a device, and why (not).
struct KernelVerdict {
    Kernel kernel;
    bool is_used;
    std::string reason;
};
std::vector<KernelVerdict> kernel_verdicts(const vulkan::Device& device, const SimulationModel& model,
                                           const Kernels& asked);

/// Returns why the state of `count` cloths of this size cannot lie below each other in images (cloth/together.h),
/// stored through buffer views (shaders/include/state_store.h) where `buffered`; empty when it can.
std::string state_obstacle(const vulkan::Device& device, const Grid& grid, std::uint32_t count, bool buffered);

}  // namespace drape
