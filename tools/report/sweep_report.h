// A sweep as one HTML page: how many runs are done, their last pictures, scatter plots of results by what was drawn,
// and a line per run with its values.
#pragma once

#include <filesystem>
#include <string>

namespace drape::report {

/// Returns whether a folder is a sweep's.
bool is_sweep_folder(const std::filesystem::path& path);

/// Returns the page of a sweep, which may be going on: the runs that have a record in jobs/, with links to their
/// folders, or to their own pages where they have one. Throws OutputError when a file of the sweep cannot be read.
std::string sweep_html(const std::filesystem::path& path);

}  // namespace drape::report
