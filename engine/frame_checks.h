// What makes a frame no result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "cloth/watch.h"
#include "drape/simulation.h"

namespace drape {

/// Why the frame is not a result: the first particle that is not finite; nothing when all are.
std::optional<std::string> divergence(const SimulationModel& model, std::uint32_t frame,
                                      const std::vector<ClothStatistics>& cloths);

/// Why the frame is not within the scene's tolerance: the first cloth whose RMS stretch error is above it.
std::optional<std::string> missed_tolerance(const SimulationModel& model, std::uint32_t frame,
                                            const std::vector<ClothStatistics>& cloths);

/// The first of: not finite, not plausible, above the scene's tolerance. Nothing where there are no statistics.
std::optional<FrameFailure> frame_failure(const SimulationModel& model, Watch& watch, const FinishedFrame& frame);

/// Throws it: Diverged or ToleranceMissed.
[[noreturn]] void raise(const FrameFailure& failure);

}  // namespace drape
