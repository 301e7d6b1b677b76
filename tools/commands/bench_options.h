// The options that benchmarks share.
#pragma once

#include "bench/bench_run.h"
#include "options.h"
#include "program.h"

namespace drape::cli {

/// --device, --validate, -q
void add_bench_options(CLI::App& command, bench::BenchRequest& request);

/// The words of a benchmark's help on its cases.
struct CaseWords {
    const char *names,  ///< of --filter: what case names are like
        *is_short,      ///< of --short
        *json, *csv, *svg;
};
/// The same and --filter, --short, --budget, --json, --csv, --svg.
void add_case_options(CLI::App& command, const CaseWords& words, bench::SelectedCases& request);

/// Runs a benchmark, prints its tables and says how it ended. `kept`: what becomes of a benchmark that is stopped.
ExitCode run_benchmark(bench::BenchRequest& request, const std::string& kept,
                       const std::function<bench::BenchSummary()>& run);
/// The words on benchmarks that go on with what they find in a folder.
std::string kept_in(const std::string& folder);

}  // namespace drape::cli
