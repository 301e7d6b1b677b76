#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "control/watch.h"
#include "drape/simulation.h"

namespace drape {

/// Returns the first failure among: a particle that is not finite, a value that is not plausible (control/watch.h), a
/// cloth whose RMS stretch error is above the scene's tolerance. Without statistics there is none.
std::optional<FrameFailure> frame_failure(const SimulationModel& model, Watch& watch, const FinishedFrame& frame);

/// Throws the failure, as Diverged or ToleranceMissed.
[[noreturn]] void raise(const FrameFailure& failure);

}  // namespace drape
