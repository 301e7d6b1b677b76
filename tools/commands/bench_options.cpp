#include "commands/bench_options.h"

#include <fmt/format.h>

#include "ending.h"
#include "streams.h"

namespace drape::cli {

void add_bench_options(CLI::App& command, bench::BenchRequest& request) {
    add_device_option(command, request.device);
    add_validate_option(command, request.validate);
    add_flag(command, "-q,--quiet", "No progress", request.quiet);
}

void add_case_options(CLI::App& command, const CaseWords& words, bench::SelectedCases& request) {
    add_option(command, "--filter", "REGEX",
               std::string("Only cases whose name contains this regular expression; names are ") + words.names,
               request.filter);
    add_flag(command, "--short", words.is_short, request.is_short);
    add_option(
        command, "--budget", "MINUTES",
        "Start no case that would end later than after so many minutes, the important cases first; default: no limit",
        number("minutes above 0", above_zero, 1e6, [&request](double minutes) { request.budget_minutes = minutes; }));
    add_option(command, "--json", "FILE", words.json, request.json);
    add_option(command, "--csv", "FILE", words.csv, request.csv);
    add_option(command, "--svg", "DIR", words.svg, request.svg);
    add_bench_options(command, request);
}

std::string kept_in(const std::string& folder) {
    return fmt::format("the finished cases are kept in {}; the same command goes on from there", folder);
}

ExitCode run_benchmark(bench::BenchRequest& request, const std::string& kept,
                       const std::function<bench::BenchSummary()>& run) {
    catch_signals();
    request.stop = stop_requested;
    request.message = print_message;
    bench::BenchSummary summary;
    try {
        summary = run();
    } catch (const bench::Stopped&) {
        return report_stop(kept);
    }
    print_data(summary.text);
    if (!request.quiet)
        print_message(fmt::format("{} cases run, {} kept from before, {} left out", summary.run_count,
                                  summary.kept_count, summary.left_out_count));
    if (summary.validation_count > 0) return report_validation(summary.validation_count);
    if (summary.missed.empty()) return ExitCode::ok;
    print_error(summary.missed);
    return ExitCode::comparison;
}

}  // namespace drape::cli
