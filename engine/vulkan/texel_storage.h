// Shaders read large arrays as texel buffers, which the default device loads several times as fast (docs/devices.md).
// Vulkan promises 65,536 texels of one; a device that has no more gets the same modules with storage buffers in their
// place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace drape::vulkan {

/// Returns the module with every rgba32f texel buffer, which it only reads, as a storage buffer of vec4 at the same
/// binding. A module without one is returned as it is.
std::vector<std::uint32_t> texels_as_storage(std::span<const std::uint32_t> module);

}  // namespace drape::vulkan
