// What makes a frame no result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "cloth/watch.h"
#include "drape/simulation.h"

namespace drape {

/// The first of: a particle that is not finite, something not plausible (cloth/watch.h), a cloth whose RMS stretch
/// error is above the scene's tolerance. Nothing where there are no statistics.
std::optional<FrameFailure> frame_failure(const SimulationModel& model, Watch& watch, const FinishedFrame& frame);

/// Throws it: Diverged or ToleranceMissed.
[[noreturn]] void raise(const FrameFailure& failure);

}  // namespace drape
