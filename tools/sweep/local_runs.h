// Runs of a sweep on this machine have a process each, or one for those that go on together; a crash takes one run with
// it: the others of its process are made again, alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep_folder.h"

namespace drape::sweep {

struct LocalRuns {
    std::vector<std::vector<std::uint32_t>> groups;  ///< runs of a process each
    std::uint32_t processes = 1;                     ///< running at a time
    /// Returns the command line of a process, which writes the records; where it could not the caller does.
    std::function<std::vector<std::string>(const std::vector<std::uint32_t>&)> command;
    std::function<bool()> stop;  ///< asked when a process ends and when a signal comes; true: end all
    bool quiet = false;
    bool dataset = false;
};

/// Returns whether all runs came to the end; false: stopped, and the runs that were going have no record.
bool run_locally(const LocalRuns& runs, const SweepFolder& folder);

/// Has the system kill this process with the sweep that started it, if one did: --resume would meet it at its run.
void end_with_sweep();

}  // namespace drape::sweep
