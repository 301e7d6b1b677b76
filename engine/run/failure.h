// Translates an exception into the exit code and the message with which a command ends.
#pragma once

#include <string>

#include "run/exit_code.h"

namespace drape {

struct Failure {
    ExitCode code;
    std::string text;
    bool is_located = false;  ///< the text names the place itself, so no prefix is needed
};

/// Returns the failure of the current exception. Call it in a catch block.
Failure current_failure();

}  // namespace drape
