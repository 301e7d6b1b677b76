#include "bench/benchmarks.h"
#include "commands/bench_options.h"

namespace drape::cli {

namespace {

std::string set_errors(const std::string& text, std::vector<double>& errors) {
    std::vector<double> wanted;
    const SetText take =
        number("metres above 0, separated by commas", above_zero, 1e6, [&](double error) { wanted.push_back(error); });
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        if (const std::string wrong = take(text.substr(at, end - at)); !wrong.empty()) return wrong;
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
               whole(1, request.frames));
    add_option(command, "--error", "METRES,...",
               "Of SCENE: RMS position errors whose cheapest setting is wanted; default: 0.1,0.01,0.001,0.0001",
               [&request](const std::string& text) { return set_errors(text, request.errors); });
    add_option(command, "--reference-substeps", "N",
               "Of SCENE: substeps per frame of the finest reference, at most, and at least 16; default: 1280",
               whole(16, request.reference_substeps));
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
                                    [=] {
                                        return run_benchmark(*request, kept_in(request->folder),
                                                             [=] { return bench::run_accuracy(*request); });
                                    });
    add_options(command, *request);
}

}  // namespace drape::cli
