// What each command of `drape` does; drape_main.cpp parses the command line into these.
#pragma once

#include <string>
#include <vector>

#include "bench/accuracy.h"
#include "drape.h"

namespace drape::cli {

/// Renders or simulates into a folder.
ExitCode run(RunRequest request);

/// Prints the plan of a frame.
ExitCode graph(const SceneRequest& request, bool draw, const std::string& format);

/// Checks scene files; every error of every file on stderr, or as JSON on stdout.
ExitCode check(const std::vector<std::string>& paths, const std::vector<std::string>& overrides, bool json, bool quiet);

ExitCode schema();

ExitCode devices(bool json);

/// Measures errors against work; the table on stdout.
ExitCode bench_accuracy(bench::AccuracyRequest request);

/// The exit code that the current exception stands for; prints its message. Call in a catch block.
ExitCode report_current_exception();

}  // namespace drape::cli
