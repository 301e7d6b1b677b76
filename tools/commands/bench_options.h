#pragma once

#include "bench/bench_run.h"
#include "options.h"
#include "program.h"

namespace drape::cli {

/// Adds --device, --validate, -q.
void add_bench_options(CLI::App& command, bench::BenchRequest& request);

/// Words on a benchmark's cases for its help.
struct CaseWords {
    const char *names,  ///< help of --filter: how case names look
        *is_short,      ///< help of --short
        *json, *csv, *svg;
};
/// Adds the options of add_bench_options and --filter, --short, --budget, --json, --csv, --svg.
void add_case_options(CLI::App& command, const CaseWords& words, bench::SelectedCases& request);

/// Runs a benchmark, prints its tables and says how it ended. `kept`: what becomes of a benchmark that is stopped.
ExitCode run_benchmark(bench::BenchRequest& request, const std::string& kept,
                       const std::function<bench::BenchSummary()>& run);
/// The words on benchmarks that go on with what they find in a folder.
std::string kept_in(const std::string& folder);

}  // namespace drape::cli
