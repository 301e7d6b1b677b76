#include "profile/profile.h"

#include <fmt/format.h>

#include "ending.h"
#include "options.h"
#include "output/atomic_file.h"
#include "profile/profile_report.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct ProfileOptions {
    profile::ProfileRequest request;
    bool simulate = false;
    std::string json, csv, trace;
};

ExitCode run(ProfileOptions options) {
    catch_signals();
    options.request.stop = stop_requested;
    options.request.draw = !options.simulate;
    const profile::Profile result = profile::run_profile(options.request);
    if (result.stopped) return report_stop("no profile was written");
    if (!result.failure.empty())
        print_message("warning: these are times of frames that are no result: " + result.failure);
    print_data(profile::profile_text(result));
    if (!options.json.empty()) write_file(options.json, profile::profile_json(result));
    if (!options.csv.empty()) write_file(options.csv, profile::profile_csv(result));
    if (!options.trace.empty()) write_file(options.trace, profile::profile_trace(result));
    return ExitCode::ok;
}

}  // namespace

void add_profile(Program& program) {
    const auto options = std::make_shared<ProfileOptions>();
    CLI::App& command = program.add("profile", "Where a frame's time goes, by the device's timestamps", R"text(
Runs the scene, writes no frame, and tells per frame how long the device spent on each stage (or pass), with the spread
over the measured frames; `frame` is the time from one frame's end to the next. Where a second device draws, as in
`render` on a CPU, both work at once, and `device`, the sum of all stages, is longer. Bytes are those of what each pass
declares, read and written once; GB/s and the share of what a copy moves (64 MiB on a CPU, 1 GiB by a pass on a GPU)
follow from them. Flops are those that a kernel's functions take per particle or spring, counted; GFLOP/s follow. Where
timestamps are not supported it says "unavailable".

Examples:
  drape profile scenes/flag.json
  drape profile scenes/flag.json --simulate --passes --json before.json
  drape compare before.json after.json
)text",
                                    [=] { return run(*options); });
    add_scene_options(command, options->request.scene);
    add_image_options(command, options->request.scene);
    add_option(command, "-n,--frames", "N", "Frames to measure; default: 60", whole(1, options->request.frame_count));
    add_option(command, "--warm-up", "N", "Frames before them, not measured; default: 5",
               whole(1, options->request.warm_up));
    add_flag(command, "--passes", "By pass; each timestamp costs about 10 us on a CPU", options->request.passes);
    add_flag(command, "--simulate", "As `drape simulate` runs it: nothing is drawn", options->simulate);
    add_option(command, "--json", "FILE", "Also as JSON shaped like Google Benchmark's, every frame a repetition",
               options->json);
    add_option(command, "--csv", "FILE", "Also as CSV", options->csv);
    add_option(command, "--trace", "FILE", "Also as a Chrome trace, for chrome://tracing or Perfetto", options->trace);
}

}  // namespace drape::cli
