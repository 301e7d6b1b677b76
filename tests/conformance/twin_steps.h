// The plain steps of a frame, which the twin takes, by the device's steps, of which some do several of them.
#pragma once

#include <vector>

#include "cloth/step.h"

namespace drape::test {

/// A step of the device and the cloths that it is taken for.
struct DeviceStep {
    Step step;
    std::vector<std::size_t> cloths;
};

/// Returns for each of the device's steps the plain steps that it does: of each of its cloths those from where the
/// step before it ended up to where the next one begins, which is its like, of the same kind, substep and iteration,
/// or, where it joins others and has none, the first of its substep and iteration.
std::vector<std::vector<Step>> twin_steps(const std::vector<Step>& plain, const std::vector<DeviceStep>& device,
                                          std::size_t cloth_count);

}  // namespace drape::test
