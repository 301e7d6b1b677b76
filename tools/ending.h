// The program ends stopped by a signal, or with a failure's message and exit code.
#pragma once

#include <cstdint>
#include <string>

#include "run/failure.h"

namespace drape::cli {

/// From here on SIGINT and SIGTERM are remembered; a second one ends the program at once.
void catch_signals();

/// Returns whether SIGINT or SIGTERM came.
bool stop_requested();

/// Says which signal it was and what became of the work.
ExitCode report_stop(const std::string& consequence);

ExitCode report_validation(std::uint64_t message_count);

/// Prints the current exception's message and returns the exit code that it stands for. Call it in a catch block.
ExitCode report_current_exception();

}  // namespace drape::cli
