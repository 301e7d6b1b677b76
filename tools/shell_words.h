// Completions of shells and the manual page are derived from the table of commands and options.
#pragma once

#include <string>
#include <vector>

#include "program.h"

namespace drape::cli {

/// Returns the words that may stand at the place of the last of these, the words after `drape`: a line each, with a tab
/// and a description; or the line :files or :folders.
std::string completions(const std::vector<CommandText>& commands, const std::vector<std::string>& words);

/// Returns a script that asks `drape completions words -- WORD...` at every completion; to be sourced (bash),
/// autoloaded as _drape (zsh) or put where fish looks. Empty for another shell.
std::string completion_script(const std::string& shell);

/// Returns drape(1), in the man macros of roff.
std::string manual_page(const std::vector<CommandText>& commands, const std::string& version);

}  // namespace drape::cli
