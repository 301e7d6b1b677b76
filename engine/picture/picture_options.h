#pragma once

#include <cstdint>

#include "drape/view.h"
#include "graph/executor.h"

namespace drape {

struct PictureOptions {
    std::uint32_t width = 1280, height = 720, samples = 4;
    bool color = true;    ///< pictures
    bool layers = false;  ///< layers, which are of the same size
    PictureView view;
    graph::TimestampMode timestamps = graph::TimestampMode::stages;
    bool positions = false;         ///< position arrays are wanted too
    bool velocities = false;        ///< velocities likewise, at the frame's end, which needs statistics
    std::uint32_t motion_blur = 1;  ///< ImageSettings::motion_blur
};

}  // namespace drape
