// One scene of a trial of `auto`: run, compared with converged runs of itself, timed against fixed settings.
#pragma once

#include <functional>

#include "bench/trial_result.h"
#include "drape/device.h"

namespace drape::bench {

/// Fills all of the result but name and key. `stop` is asked before every frame; throws Stopped when it said so.
TrialResult try_scene(const Device& device, const SceneDescription& scene, bool with_reference,
                      const std::function<bool()>& stop);

}  // namespace drape::bench
