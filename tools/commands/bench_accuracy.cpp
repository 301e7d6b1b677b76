#include <fmt/format.h>

#include <cstdlib>

#include "bench/accuracy.h"
#include "ending.h"
#include "options.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

ExitCode measure(bench::AccuracyRequest request) {
    catch_signals();
    request.stop = stop_requested;
    request.message = print_message;
    const bench::AccuracySummary summary = bench::run_accuracy(request);
    if (summary.stopped)
        return report_stop(
            fmt::format("the finished cases are kept in {}; the same command goes on from there", request.folder));
    print_data(summary.text);
    if (!request.quiet)
        print_message(fmt::format("{} cases measured, {} kept from before, {} left out by --budget",
                                  summary.measured_count, summary.kept_count, summary.left_out_count));
    if (summary.validation_count > 0) return report_validation(summary.validation_count);
    if (summary.missed_count == 0) return ExitCode::ok;
    print_error(fmt::format("{} of the benchmark's limits, orders and promises not met", summary.missed_count));
    return ExitCode::comparison;
}

std::string set_minutes(const std::string& text, bench::AccuracyRequest& request) {
    char* end = nullptr;
    const double minutes = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != 0 || !(minutes > 0 && minutes < 1e6))
        return "expected minutes above 0, got '" + text + "'";
    request.budget_minutes = minutes;
    return {};
}

void add_options(CLI::App& command, bench::AccuracyRequest& request) {
    add_option(command, "--filter", "REGEX",
               "Only cases whose name contains this regular expression; names are\n"
               "PROBLEM/N/METHOD/SUBSTEPS or .../SUBSTEPSxITERATIONS, as in swing/64/relax/20;\n"
               "default: all",
               request.filter);
    add_flag(command, "--short", "A few small cases of every problem: under 3 minutes", request.is_short);
    add_option(command, "--folder", "DIR",
               "Where finished cases and references are kept: the same command goes on from\n"
               "there, and only what has changed is measured again; default: bench",
               request.folder);
    add_option(command, "--budget", "MINUTES",
               "Start no case that would end later than after so many minutes, the important\n"
               "cases first; default: no limit",
               [&request](const std::string& text) { return set_minutes(text, request); });
    add_option(command, "--json", "FILE", "Write results, orders, limits and ratios as JSON", request.json);
    add_option(command, "--csv", "FILE", "Write a row per case", request.csv);
    add_option(command, "--svg", "DIR", "Write plots of error against time, passes, substeps and N", request.svg);
    add_device_option(command, request.device);
    add_validate_option(command, request.validate);
    add_flag(command, "-q,--quiet", "No progress", request.quiet);
}

}  // namespace

void add_bench_accuracy(Program& program) {
    program.add("bench", "Measure every solver: `drape bench accuracy`, error against work",
                "\nExample:\n  drape bench accuracy --short\n", nullptr);
    const auto request = std::make_shared<bench::AccuracyRequest>();
    CLI::App& command = program.add("bench accuracy", "Error against time, substeps, iterations and size", R"text(
Runs reference problems by every solver at many settings and compares with closed forms and converged
double-precision solutions. On stdout a table of errors and times, fitted orders of convergence, limits met, and
which solver meets an error soonest. Times are the device's, of the simulation alone: medians over repetitions.
When a limit or an order is not met, it ends with exit code 7, everything written all the same.
The full benchmark takes hours on a CPU, references included; SIGINT ends it, and the same command goes on.

Examples:
  drape bench accuracy --short --svg out/plots
  drape bench accuracy --filter '^(swing|drum)/(64|128)/' --json out/swing.json
  drape bench accuracy --budget 120 --json out/accuracy.json --csv out/accuracy.csv --svg out/plots
)text",
                                    [=] { return measure(*request); });
    add_options(command, *request);
}

}  // namespace drape::cli
