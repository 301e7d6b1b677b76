// Runs of a sweep on this machine have a process each, so that a crash takes one run with it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep_folder.h"

namespace drape::sweep {

struct LocalRuns {
    std::vector<std::uint32_t> indices;  ///< to run
    std::uint32_t processes = 1;         ///< running at a time
    /// Returns the command line of a run's process, which writes the record; where it could not the caller does.
    std::function<std::vector<std::string>(std::uint32_t)> command;
    std::function<bool()> stop;  ///< asked when a process ends and when a signal comes; true: end all
    bool quiet = false;
    bool dataset = false;
};

/// Returns whether all runs came to the end; false: stopped, and the runs that were going have no record.
bool run_locally(const LocalRuns& runs, const SweepFolder& folder);

}  // namespace drape::sweep
