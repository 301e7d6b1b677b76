// Runs of a sweep on this machine: one process each, so that a crash takes one run with it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep_folder.h"

namespace drape::sweep {

struct LocalRuns {
    std::vector<std::uint32_t> indices;  ///< to run
    std::uint32_t processes = 1;         ///< at a time
    /// The command line of a run's process; it writes the record, and the caller does where it could not.
    std::function<std::vector<std::string>(std::uint32_t)> command;
    std::function<bool()> stop;  ///< asked when a process ends and when a signal comes; true: end all
    bool quiet = false;
    bool dataset = false;
};

/// Whether it came to the end; false: stopped, and what ran then has no record.
bool run_locally(const LocalRuns& runs, const SweepFolder& folder);

}  // namespace drape::sweep
