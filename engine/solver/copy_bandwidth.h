// A device's memory gives this measure, which passes are held against.
#pragma once

#include <cstdint>

#include "vulkan/device.h"

namespace drape {

/// This says how two buffers are copied. On a GPU a copy command moves a fifth of what a pass can (H200: 820 and
/// 4,260 GB/s), and 64 MiB lie in its cache; on a CPU a pass moves less than the command, which is the library's
/// memcpy.
struct CopyRuler {
    bool by_pass;
    std::uint64_t byte_count;  ///< of each buffer
};
/// Returns that of the device's kind: 64 MiB by a command on a CPU, 1 GiB by a pass on a GPU, or what it has room for.
CopyRuler copy_ruler(const vulkan::Device& device);

/// Returns the bytes per second that such a copy reads and writes: median of several after a first one. 0 where the
/// device has no timestamps. Throws VulkanError when it has not the memory.
double copy_bandwidth(const vulkan::Device& device, CopyRuler ruler);

}  // namespace drape
