#include "commands/run_command.h"

#include <fmt/format.h>

#include "ending.h"
#include "streams.h"

namespace drape::cli {

ExitCode run_into_folder(RunRequest request, const std::vector<std::string>& command_line) {
    catch_signals();
    request.command_line = command_line;
    request.stop = stop_requested;
    request.message = print_message;
    const RunSummary summary = run_scene(request);
    const std::uint64_t count = summary.frame_count + summary.kept_count;
    const std::string frames = fmt::format("{} frame{} in {}", count, count == 1 ? "" : "s", request.output);
    if (!summary.complete) {
        std::string left = summary.dropped.size() < request.formats.size() ? frames + "; " : "";
        if (!summary.dropped.empty())
            left += fmt::format("{}, incomplete, dropped; ", fmt::join(summary.dropped, ", "));
        return report_stop(left + "no manifest was written" +
                           (request.draws() ? "; --resume draws the missing ones" : ""));
    }
    if (summary.validation_count > 0) return report_validation(summary.validation_count);
    const std::string kept = summary.kept_count > 0 ? fmt::format(" ({} of them kept)", summary.kept_count) : "";
    if (!request.quiet) print_message(frames + kept);
    return ExitCode::ok;
}

}  // namespace drape::cli
