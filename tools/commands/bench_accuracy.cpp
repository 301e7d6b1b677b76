#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "bench/accuracy.h"
#include "commands/bench_options.h"
#include "ending.h"
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

std::string set_errors(const std::string& text, std::vector<double>& errors) {
    std::vector<double> wanted;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string part = text.substr(at, end - at);
        char* rest = nullptr;
        wanted.push_back(std::strtod(part.c_str(), &rest));
        if (part.empty() || *rest != 0 || !(wanted.back() > 0 && wanted.back() < 1e6))
            return "expected metres above 0, separated by commas, got '" + text + "'";
        at = end + 1;
    }
    errors = wanted;
    return {};
}

void add_user_scene_options(CLI::App& command, bench::AccuracyRequest& request) {
    add_optional_file(
        command, "SCENE",
        "Scene file to be measured against its own refined runs; without one the benchmark's reference problems are",
        request.scene);
    add_override_option(command, request.overrides);
    add_option(command, "--frames", "N", "Of SCENE: at most N frames after the first; default: all",
               whole(1, [&request](std::uint32_t value) { request.frames = value; }));
    add_option(command, "--error", "METRES,...",
               "Of SCENE: RMS position errors whose cheapest setting is wanted; default: 0.1,0.01,0.001,0.0001",
               [&request](const std::string& text) { return set_errors(text, request.errors); });
    add_option(command, "--reference-substeps", "N",
               "Of SCENE: substeps per frame of the finest reference, at most, and at least 16; default: 1280",
               whole(16, [&request](std::uint32_t value) { request.reference_substeps = value; }));
}

void add_options(CLI::App& command, bench::AccuracyRequest& request) {
    add_user_scene_options(command, request);
    add_option(command, "--folder", "DIR",
               "Where finished cases and references are kept: the same command goes on from there, and only what has "
               "changed is measured again; of SCENE also accuracy.json, accuracy.csv and the plots; default: bench",
               request.folder);
    add_case_options(
        command,
        {"PROBLEM/N/METHOD/SUBSTEPS or .../SUBSTEPSxITERATIONS, as in swing/64/relax/20; default: all",
         "A few small cases of every problem: under 3 minutes", "Write results, orders, limits and ratios as JSON",
         "Write a row per case", "Write plots of error against time, passes, substeps and N"},
        request);
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
When a limit or an order is not met, or method auto misses its tolerance, it ends with exit code 7, everything
written all the same. The full benchmark takes hours on a CPU, references included; SIGINT ends it, and the same
command goes on.

With SCENE every method at many substeps, and auto, are measured against runs of the same scene at ever more
substeps. How far these references are off is estimated (Richardson) and stated, and errors below it are marked;
positions are compared until the two finest references part. At the end stands the cheapest setting for each wanted
error.

Examples:
  drape bench accuracy scenes/flag.json --frames 30 --error 1e-3 \
      --folder out/flag_accuracy
  drape bench accuracy --short --svg out/plots
  drape bench accuracy --filter '^(swing|drum)/(64|128)/' --json out/swing.json
  drape bench accuracy --budget 120 --json accuracy.json --csv accuracy.csv
)text",
                                    [=] { return measure(*request); });
    add_options(command, *request);
}

}  // namespace drape::cli
