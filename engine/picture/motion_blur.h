// The mean of pictures of one frame, drawn at moments while the shutter is open.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drape/frame.h"

namespace drape {

/// The mean of pictures (RGBA8, sRGB, straight alpha) in linear light, each pixel weighted by what covers it. The mean
/// of equal pictures is each of them, to the byte.
class PictureMean {
  public:
    /// Begins anew.
    void clear();
    /// Adds a picture of the size of those before; at most 256 may be added.
    void add(std::span<const std::uint8_t> rgba);
    /// Returns the mean, until the next call of any member.
    std::span<const std::uint8_t> mean();

  private:
    std::vector<std::uint32_t> sums_;  ///< of linear light times alpha, and of alpha
    std::uint32_t count_ = 0;
    std::vector<std::uint8_t> rgba_;
};

/// Returns positions x y z w, m, as they were `ago` s before, at these velocities, m/s.
std::vector<float> positions_before(std::span<const float> positions, std::span<const float> velocities, double ago);
/// Returns bodies likewise, as if each turned about the centre of its shape.
std::vector<BodyState> bodies_before(const std::vector<BodyState>& bodies, double ago);

}  // namespace drape
