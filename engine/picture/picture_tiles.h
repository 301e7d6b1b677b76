// The tiles of a picture (shaders/include/picture_tiles.h). Only tiles in which something may be drawn are cleared and
// processed: clearing all samples of a picture took longer than drawing in it, on a CPU and on a GPU (docs/devices.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "drape/scene.h"
#include "vulkan/pipeline.h"

namespace drape {

class PictureTiles {
  public:
    PictureTiles(std::uint32_t width, std::uint32_t height);
    std::uint32_t count() const { return across_ * down_; }
    /// Return the shaders' constants, and one of them by its name.
    std::vector<vulkan::SpecializationConstant> constants() const;
    std::uint32_t constant(std::string_view name) const;

    /// Returns the contents of the shaders' buffer for these bodies at `time` (s), by tile: 1 where a body may be
    /// drawn, otherwise 0.
    std::vector<std::uint32_t> marks(std::span<const Collider> bodies, double time, const Camera& camera) const;

  private:
    void mark(const std::array<double, 2>& low, const std::array<double, 2>& high,
              std::vector<std::uint32_t>& marks) const;
    std::uint32_t width_, height_, shift_ = 5, across_, down_;
};

}  // namespace drape
