// One case of the stability benchmark, run and judged.
#pragma once

#include <functional>

#include "bench/stability_result.h"
#include "drape/device.h"

namespace drape::bench {

/// Fills all but the key. `stop` is asked before every frame. Throws Stopped when it said so, and DeviceError.
StabilityResult run_stability_case(const Device& device, const StabilityCase& each, const std::function<bool()>& stop);

}  // namespace drape::bench
