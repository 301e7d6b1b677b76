#pragma once

#include <cstdint>

#include "drape/view.h"
#include "graph/executor.h"

namespace drape {

struct PictureOptions {
    std::uint32_t width = 1280, height = 720, samples = 4;
    PictureView view;
    graph::TimestampMode timestamps = graph::TimestampMode::stages;
    bool positions = false;  ///< position arrays are wanted too
};

}  // namespace drape
