#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "control/watch.h"
#include "drape/simulation.h"

namespace drape {

/// Returns the first of: a particle that is not finite, something not plausible (control/watch.h), a cloth whose RMS
/// stretch error is above the scene's tolerance. There is none without statistics.
std::optional<FrameFailure> frame_failure(const SimulationModel& model, Watch& watch, const FinishedFrame& frame);

/// Throws it as Diverged or ToleranceMissed.
[[noreturn]] void raise(const FrameFailure& failure);

}  // namespace drape
