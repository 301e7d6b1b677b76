#pragma once

#include <span>
#include <vector>

#include "drape/frame.h"

namespace drape {

/// A frame that outlives the buffers it was read from.
class FrameCopy {
  public:
    void keep(const FinishedFrame& frame) {
        frame_ = frame;
        rgba_.assign(frame.rgba.begin(), frame.rgba.end());
        frame_.rgba = rgba_;
        layers_.assign(frame.layers.begin(), frame.layers.end());
        frame_.layers = layers_;
        keep(frame.positions, positions_, frame_.positions);
        keep(frame.velocities, velocities_, frame_.velocities);
        keep(frame.normals, normals_, frame_.normals);
        keep(frame.tensions, tensions_, frame_.tensions);
        keep(frame.contact_forces, contact_forces_, frame_.contact_forces);
    }
    const FinishedFrame& frame() const { return frame_; }
    FrameEffort& effort() { return frame_.effort; }

  private:
    using Arrays = std::vector<std::vector<float>>;
    static void keep(const std::vector<std::span<const float>>& from, Arrays& arrays,
                     std::vector<std::span<const float>>& views) {
        arrays.resize(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) {
            arrays[i].assign(from[i].begin(), from[i].end());
            views[i] = arrays[i];
        }
    }

    FinishedFrame frame_;
    std::vector<std::uint8_t> rgba_;
    std::vector<LayerPixel> layers_;
    Arrays positions_, velocities_, normals_, tensions_, contact_forces_;
};

}  // namespace drape
