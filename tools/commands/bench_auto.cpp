#include <fmt/format.h>

#include <cstdlib>

#include "bench/auto_trial.h"
#include "commands/bench_options.h"
#include "ending.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

ExitCode run(bench::TrialRequest request) {
    catch_signals();
    request.stop = stop_requested;
    request.message = print_message;
    const bench::TrialSummary summary = bench::run_trial(request);
    if (summary.stopped)
        return report_stop(
            fmt::format("the finished scenes are kept in {}; the same command goes on from there", request.folder));
    print_data(summary.text);
    if (!request.quiet)
        print_message(fmt::format("{} scenes run, {} kept from before", summary.run_count, summary.kept_count));
    if (summary.validation_count > 0) return report_validation(summary.validation_count);
    if (!summary.fails) return ExitCode::ok;
    print_error("method auto refused more than 1 % of the scenes, or handed out frames that miss their limits");
    return ExitCode::comparison;
}

std::string set_tolerance(const std::string& text, double& tolerance) {
    char* end = nullptr;
    tolerance = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && *end == 0 && tolerance > 0 && tolerance < 1) return {};
    return "expected an RMS stretch error between 0 and 1, got '" + text + "'";
}

}  // namespace

void add_bench_auto(Program& program) {
    const auto request = std::make_shared<bench::TrialRequest>();
    CLI::App& command =
        program.add("bench auto", "What method auto keeps and costs, on scenes drawn from a seed", R"text(
Runs scenes of method auto by the library and judges every frame from outside: kept, refused (with the reason), or
handed out though it misses the stretch error that was asked for (1 % where nothing was). With --reference also the
true RMS position error, against method line at 4 and 8 times the most substeps that auto took, how well the run's own
estimate predicts it, and the time over that of the soonest fixed setting of line and explicit that keeps the same
limits. A table on stdout; DIR/scenes.jsonl has a line per scene. It ends with exit code 7 when more than 1 % of the
scenes were refused or a frame missed its limit silently. SIGINT ends it, and the same command goes on; another
program, device or option starts anew.

Examples:
  drape bench auto --count 20
  drape bench auto --generator a --seed 7 --tolerance 0.002 --reference \
      -o out/auto
  drape bench auto --first 17 --count 1            scene 17 again
)text",
                    [=] { return run(*request); });
    add_option(command, "--generator", "a|b",
               "Where scenes come from: a, such as auto is tuned on, or b, written apart and never used for tuning; "
               "default: b",
               request->generator);
    add_option(command, "--count", "N", "How many scenes; default: 100",
               whole(1, [=](std::uint32_t value) { request->count = value; }));
    add_option(command, "--first", "N", "Number of the first; default: 0",
               whole(0, [=](std::uint32_t value) { request->first = value; }));
    add_option(command, "--seed", "N", "Another seed, other scenes; default: 1",
               whole(0, [=](std::uint32_t value) { request->seed = value; }));
    add_option(command, "--tolerance", "ERROR", "The scenes' tolerance; default: they ask for none",
               [=](const std::string& text) { return set_tolerance(text, request->tolerance); });
    add_flag(command, "--reference", "Measure position errors and times against other settings (takes long)",
             request->reference);
    add_option(command, "-o,--folder", "DIR", "Where finished scenes are kept; default: bench_auto", request->folder);
    add_bench_options(command, *request);
}

}  // namespace drape::cli
