// Runs of one shape go on together, in one process, as members of an ensemble.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/device_costs.h"
#include "run/run.h"

namespace drape::sweep {

struct GroupedRun {
    std::uint32_t index;
    RunRequest request;
};

/// A group has at most so many runs, whose files are open at the same time.
inline constexpr std::size_t most_grouped = 256;

/// Returns whether runs of this scene can share dispatches on such a device, and gain by it: no cloth is cut or fills
/// the device alone (cloth/members.h has the rest), and no file has pictures.
bool can_be_grouped(const RunRequest& request, DeviceKind device);

/// Returns the runs in lists of those that go on together, in order. One that goes on alone is in a list of its own.
std::vector<std::vector<GroupedRun>> groups_of(std::vector<GroupedRun> runs, DeviceKind device);

}  // namespace drape::sweep
