#include "bench/benchmarks.h"
#include "commands/bench_options.h"

namespace drape::cli {

void add_bench_speed(Program& program) {
    const auto request = std::make_shared<bench::SpeedRequest>();
    CLI::App& command = program.add(
        "bench speed", "Drape's times beside the device's own and a memory copy",
        R"text(
Per substep of every solver: Drape's time, the device's own, and that of a copy
between buffers (64 MiB on a CPU, 1 GiB by a pass on a GPU) of as many bytes as
the passes declare. GB/s and GFLOP/s follow from what they declare, too; `of
copy` is the share of what the copy moves. Sheets of 32x32 to 2048x2048
particles, up to 64 cloths and 64 colliders; pictures; ensembles of 1 to 4096
members of 32x32, beside processes; what skips save on the shipped scenes;
starts of a program, with an empty shader cache (cold) and a full one (warm).
The sides of a comparison take turns. Medians over rounds; times whose
interquartile range is above 30 % are marked doubtful.

Examples:
  drape bench speed --short
  drape bench speed --filter '^line/' --svg out/plots
  drape bench speed --tune --short
  drape bench speed --budget 20 --json out/speed.json --csv out/speed.csv
)text",
        [=] { return run_benchmark(*request, "nothing was written", [=] { return bench::run_speed(*request); }); });
    add_flag(
        command, "--tune",
        "Measure instead every set of kernels (--kernels of render and simulate) that\nthe device can run, by method, "
        "size and number of cloths, beside the one\nthat `auto` takes",
        request->tune);
    add_option(command, "--scenes", "DIR", "Where the shipped scenes are, for skips; default:\nscenes",
               request->scenes);
    add_case_options(
        command,
        {"METHOD/N, METHOD/N/COUNT cloths or colliders, ensemble/..., picture/..., skip/..., start/..., with --tune "
         "kernels/METHOD/...; default: all",
         "Sheets of at most 256x256 and shorter rounds: under 2 minutes on an idle machine",
         "Write times, ratios and scaling as JSON", "Write a row per case and time",
         "Write plots of time against particles, cloths and colliders"},
        *request);
}

}  // namespace drape::cli
