#include "commands/run_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "base/printable_text.h"
#include "ending.h"
#include "output/frame_writer.h"
#include "streams.h"

namespace drape::cli {

namespace {

/// Streams video instead of writing files; of the formats only one can be a stream.
void stream_to_stdout(RunRequest& request) {
    const bool drawn = request.draws();
    std::erase(request.formats, "png");
    if (drawn && request.formats.empty()) request.formats = {"y4m"};
    const OutputFormat* format = request.formats.size() == 1 ? find_output_format(request.formats[0]) : nullptr;
    if (!format || !format->stream)
        throw UsageError(drawn ? fmt::format("with -o - --export takes one of {}", stream_format_names())
                               : "only `drape render` writes to stdout: name a folder, ./- for one of that name");
    if (isatty(STDOUT_FILENO)) throw UsageError("stdout is a terminal: send the video to a program or a file");
    request.stream = [](std::span<const std::byte> bytes) {
        print_data({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    };
}

}  // namespace

ExitCode run_into_folder(RunRequest request, const std::vector<std::string>& command_line) {
    catch_signals();
    request.command_line = command_line;
    request.stop = stop_requested;
    request.saving = take_time;
    request.message = print_message;
    if (request.output == "-") stream_to_stdout(request);
    const RunSummary summary = run_scene(request);
    const std::uint64_t count = summary.frame_count + summary.kept_count;
    const std::string frames = fmt::format("{} frame{} {}", count, count == 1 ? "" : "s",
                                           request.stream ? "to stdout" : "in " + printable(request.output));
    if (!summary.complete) {
        if (request.stream) return report_stop("the video ends after " + frames);
        std::string left = summary.dropped.size() < request.formats.size() ? frames + "; " : "";
        if (!summary.dropped.empty())
            left += fmt::format("{}, incomplete, dropped; ", fmt::join(summary.dropped, ", "));
        return report_stop(left + "no manifest was written" +
                           (summary.checkpoint ? fmt::format("; --resume goes on from frame {}", *summary.checkpoint)
                            : request.draws()  ? "; --resume draws the missing ones"
                                               : ""));
    }
    if (summary.validation_count > 0) return report_validation(summary.validation_count);
    const std::string kept = summary.kept_count > 0 ? fmt::format(" ({} of them kept)", summary.kept_count) : "";
    if (!request.quiet) print_message(frames + kept);
    return ExitCode::ok;
}

}  // namespace drape::cli
