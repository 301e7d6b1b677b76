// bench/stability_judge.cpp asks for the rows about pins alone; this goes with it.
#pragma once

#include "control/impossible_scene.h"

namespace drape {

inline std::string impossible_pins(const SimulationModel& model, std::uint32_t frame) {
    return impossible_scene(model, frame, scene_bounds().first(2));
}

}  // namespace drape
