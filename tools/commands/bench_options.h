#pragma once

#include "bench/bench_request.h"
#include "options.h"

namespace drape::cli {

/// Adds --device, --validate, -q.
void add_bench_options(CLI::App& command, bench::BenchRequest& request);

/// Words on a benchmark's cases for its help; lines of at most 80 columns.
struct CaseWords {
    const char *names,  ///< help of --filter: how case names look
        *is_short,      ///< help of --short
        *json, *csv, *svg;
};
/// Adds the options of add_bench_options and --filter, --short, --budget, --json, --csv, --svg.
void add_case_options(CLI::App& command, const CaseWords& words, bench::SelectedCases& request);

}  // namespace drape::cli
