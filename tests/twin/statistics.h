// The C++ twin of the statistics passes calls the same functions and joins in the same order.
#pragma once

#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "twin/twin.h"

namespace drape {

/// Statistics of one cloth's state at the end of a frame; `inputs` are that frame's (they hold the colliders' poses).
glsl::StatisticsRecord twin_statistics(const SimulationModel& model, std::size_t cloth, const TwinCloth& state,
                                       const FrameInputs& inputs);

}  // namespace drape
