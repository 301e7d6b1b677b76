#include "ending.h"
#include "options.h"
#include "program.h"
#include "run/reproducer.h"
#include "streams.h"

namespace drape::cli {

namespace {

ExitCode run(ReplayRequest request) {
    catch_signals();
    request.message = print_message;
    request.stop = stop_requested;
    const Replay replay = replay_reproducer(request);
    if (replay.stopped) return report_stop("the failure was not reached");
    if (!replay.reached) {
        print_error(replay.text);
        return ExitCode::comparison;
    }
    print_message("the same failure, to the bit:");
    std::rethrow_exception(replay.error);
}

}  // namespace

void add_replay(Program& program) {
    const auto request = std::make_shared<ReplayRequest>();
    CLI::App& command = program.add("replay", "Go to the failure of a failed run again", R"text(
A run that failed leaves failure.reproducer in its folder: its scene and settings, its device, its last checkpoint and what
it said. The replay goes from there to the same frame, and ends with the same message and exit code; with exit code 7 when
it came to something else.

Example:
  drape replay out/flag/failure.reproducer
)text",
                                    [=] { return run(*request); });
    add_required_file(command, "FILE", "What a failed run left", request->path);
    add_device_option(command, request->device);
    add_validate_option(command, request->validate);
}

}  // namespace drape::cli
