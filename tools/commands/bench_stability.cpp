#include "bench/benchmarks.h"
#include "commands/bench_options.h"

namespace drape::cli {

void add_bench_stability(Program& program) {
    const auto request = std::make_shared<bench::StabilityRequest>();
    CLI::App& command = program.add(
        "bench stability", "Where every method holds, bends, refuses: extremes, pairs, random scenes", R"text(
Puts extremes on a small sheet: every one alone by every method and set of kernels,
all pairs, drawn mixes of three to six; then random scenes and a long run. A
judge that shares nothing with the program's own watch sees all frames: finite,
pins where they are held, distance, energy, mass, free flight, stretch and
penetration, and whether the cloth recovers within 600 frames.

  holds      meets the numbers of an accurate run: worst spring 6 %
  bends      bounded: worst spring 2 % + 12 % Lambda, Lambda = g D^2 N^2/(h K)
  refuses    the scene is refused, or the run ends with exit code 5 or 8
  unsettled  bounded, but never back below that
  fails      anything else

A table on stdout, with every case that falls short of its tier (A must hold, B
must not fail, C must be refused); DIR/stability.jsonl has a line per case. It
ends with exit code 7 when a run ended as done though its pins were not exact,
it was outside the box, or for six frames stretched beyond three times the law.
SIGINT ends it, and the same command goes on; another program or device starts
anew.

Examples:
  drape bench stability --short
  drape bench stability --filter '^single/start' --svg out/stability
  drape bench stability --filter '^random' --random 5000 -o out/random
)text",
        [=] {
            return run_benchmark(*request, kept_in(request->folder), [=] { return bench::run_stability(*request); });
        });
    add_option(command, "--seed", "N", "Other mixes and random scenes; default: 1", whole(0, request->seed));
    add_option(command, "--mixes", "N", "How many drawn mixes; default: 1000, with --short 60",
               whole(0, request->mixes));
    add_option(command, "--random", "N", "How many random scenes; default: 500, with --short 10",
               whole(0, request->randoms));
    add_option(command, "-o,--folder", "DIR", "Where finished cases are kept; default: bench_stability",
               request->folder);
    add_case_options(command,
                     {"single/EXTREME/METHOD, single/EXTREME/METHOD/KERNELS, pair/ONE + OTHER/METHOD, mix/..., "
                      "random/..., soak/METHOD; default: all",
                      "No pairs, the kernels of auto, few mixes and random scenes: under 4 minutes on an idle machine",
                      "Write verdicts, numbers and overrides as JSON", "Write a row per case",
                      "Write a map of extremes by extremes per method"},
                     *request);
}

}  // namespace drape::cli
