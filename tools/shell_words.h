// Completions of shells and the manual page are derived from the table of commands and options.
#pragma once

#include <string>
#include <vector>

#include "program.h"

namespace drape::cli {

/// Scripts that complete commands, options, choices and files are sourced (bash), autoloaded as _drape (zsh) or put
/// where fish looks.
std::string bash_completion(const std::vector<CommandText>& commands);
std::string zsh_completion(const std::vector<CommandText>& commands);
std::string fish_completion(const std::vector<CommandText>& commands);

/// Returns drape(1), in the man macros of roff.
std::string manual_page(const std::vector<CommandText>& commands, const std::string& version);

}  // namespace drape::cli
