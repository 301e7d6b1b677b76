// An exception stands for the exit code and the message that a command ends with.
#pragma once

#include <string>

#include "run/exit_code.h"

namespace drape {

struct Failure {
    ExitCode code;
    std::string text;
    bool is_located = false;  ///< the text says itself where: nothing stands before it
};

/// Returns the failure of the current exception. Call it in a catch block.
Failure current_failure();

}  // namespace drape
