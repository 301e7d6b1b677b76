// The data set of a sweep, in the layout of MeshGraphNets' cloth sets (T. Pfaff et al., "Learning mesh-based
// simulation with graph networks", ICLR 2021): meta.json says what arrays a trajectory has.
#pragma once

#include <filesystem>

#include "sweep/sweep_spec.h"

namespace drape::sweep {

/// Gives a file another name, without another copy where the file system can. Throws OutputError.
void give_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes meta.json: field names, and type, shape and dtype of each, -1 where trajectories differ; dt, s.
void write_meta(const std::filesystem::path& folder, const SweepSpec& spec);

}  // namespace drape::sweep
