#include "bench/benchmarks.h"
#include "commands/bench_options.h"

namespace drape::cli {

void add_bench_auto(Program& program) {
    const auto request = std::make_shared<bench::TrialRequest>();
    CLI::App& command = program.add(
        "bench auto", "What method auto keeps and costs, on scenes drawn from a seed", R"text(
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
        [=] { return run_benchmark(*request, kept_in(request->folder), [=] { return bench::run_trial(*request); }); });
    add_choice(command, "--generator", {"a", "b"},
               "Where scenes come from: a, such as auto is tuned on, or b, written apart and never used for tuning; "
               "default: b",
               [=](std::size_t place) { request->generator = place == 0 ? "a" : "b"; });
    add_option(command, "--count", "N", "How many scenes; default: 100", whole(1, request->count));
    add_option(command, "--first", "N", "Number of the first; default: 0", whole(0, request->first));
    add_option(command, "--seed", "N", "Another seed, other scenes; default: 1", whole(0, request->seed));
    add_option(command, "--tolerance", "ERROR", "The scenes' tolerance; default: they ask for none",
               number("an RMS stretch error between 0 and 1", above_zero, std::nextafter(1, 0),
                      [=](double tolerance) { request->tolerance = tolerance; }));
    add_flag(command, "--reference", "Measure position errors and times against other settings (takes long)",
             request->reference);
    add_option(command, "-o,--folder", "DIR", "Where finished scenes are kept; default: bench_auto", request->folder);
    add_bench_options(command, *request);
}

}  // namespace drape::cli
