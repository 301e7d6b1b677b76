// `render` and `simulate` share this: a run into a folder.
#pragma once

#include "run/run.h"

namespace drape::cli {

ExitCode run_into_folder(RunRequest request, const std::vector<std::string>& command_line);

}  // namespace drape::cli
