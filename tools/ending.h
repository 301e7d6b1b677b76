// The program ends stopped by a signal, or with a failure's message and exit code.
#pragma once

#include <cstdint>
#include <string>

#include "run/failure.h"

namespace drape::cli {

/// From here on SIGINT and SIGTERM are remembered. A second one ends the program at once, and so do two seconds after
/// the first, unless it waits for processes that have a deadline of their own.
void catch_signals(bool waits_for_processes = false);

/// Returns whether SIGINT or SIGTERM came.
bool stop_requested();

/// Says that the work left may take longer than two seconds.
void take_time();

/// Says which signal it was and what became of the work.
ExitCode report_stop(const std::string& consequence);

ExitCode report_validation(std::uint64_t message_count);

/// Prints the current exception's message and returns the exit code that it stands for. Call it in a catch block.
ExitCode report_current_exception();

}  // namespace drape::cli
