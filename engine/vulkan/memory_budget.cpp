#include <fmt/format.h>

#include <cassert>

#include "vulkan/device.h"

namespace drape::vulkan {

namespace {

std::string size_text(std::uint64_t bytes) {
    return fmt::format("{} bytes ({:.1f} MiB)", bytes, static_cast<double>(bytes) / (1024.0 * 1024.0));
}

}  // namespace

void MemoryBudget::require(std::uint64_t bytes, std::string_view what) const {
    // Subtracting cannot wrap (used_ <= limit_ always), while adding the request could.
    if (bytes <= limit_ - used_) return;
    throw VulkanError(fmt::format("{} needs {}, but {} of the memory budget of {} are left", what, size_text(bytes),
                                  size_text(limit_ - used_), size_text(limit_)));
}

void MemoryBudget::reserve(std::uint64_t bytes, std::string_view object) {
    require(bytes, object);
    used_ += bytes;
}

void MemoryBudget::release(std::uint64_t bytes) {
    assert(bytes <= used_);
    used_ -= bytes;
}

}  // namespace drape::vulkan
