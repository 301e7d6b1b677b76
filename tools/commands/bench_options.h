// The options that benchmarks share.
#pragma once

#include "bench/bench_request.h"
#include "options.h"

namespace drape::cli {

/// --device, --validate, -q
void add_bench_options(CLI::App& command, bench::BenchRequest& request);

/// What a benchmark's help says of its cases; lines of at most 80 columns.
struct CaseWords {
    const char *names,  ///< of --filter: what case names are like
        *is_short,      ///< of --short
        *json, *csv, *svg;
};
/// Those and --filter, --short, --budget, --json, --csv, --svg.
void add_case_options(CLI::App& command, const CaseWords& words, bench::SelectedCases& request);

}  // namespace drape::cli
