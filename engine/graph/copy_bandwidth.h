// A device's memory gives this measure, which passes are held against.
#pragma once

#include "vulkan/device.h"

namespace drape::graph {

/// Returns the bytes per second that a copy of 64 MiB between buffers reads and writes: median of several after a first
/// one. 0 where the device has no timestamps. Throws VulkanError when it has not the memory.
double copy_bandwidth(const vulkan::Device& device);

}  // namespace drape::graph
