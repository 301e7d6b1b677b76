#include <fmt/format.h>

#include <filesystem>

#include "base/printable_text.h"
#include "options.h"
#include "output/atomic_file.h"
#include "program.h"
#include "report/run_report.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct ReportOptions {
    std::string folder, other, output;
    report::ReportOptions report;
};

ExitCode run(const ReportOptions& options) {
    std::vector<report::RunFolder> runs{report::read_run_folder(options.folder)};
    if (!options.other.empty()) runs.push_back(report::read_run_folder(options.other));
    const std::string html = report::report_html(runs, options.report);
    if (options.output == "-") {
        print_data(html);
        return ExitCode::ok;
    }
    const std::filesystem::path path = options.output.empty() ? std::filesystem::path(options.folder) / "report.html"
                                                              : std::filesystem::path(options.output);
    write_file(path, html);
    print_message(fmt::format("{} ({:.1f} MB)", printable(path.string()), static_cast<double>(html.size()) / 1e6));
    return ExitCode::ok;
}

}  // namespace

void add_report(Program& program) {
    const auto options = std::make_shared<ReportOptions>();
    CLI::App& command = program.add("report", "One HTML page of a run: pictures, plots, times, settings", R"text(
The page needs no network and no other file: pictures shrunk, as a player and a
contact sheet; stretch, energy, penetration and substeps over time; times by
stage; settings and warnings. With two folders both stand side by side.

Examples:
  drape report out/flag
  drape report out/flag out/calm -o compared.html
)text",
                                    [=] { return run(*options); });
    add_required_file(command, "DIR", "Folder of a finished run", options->folder);
    add_optional_file(command, "OTHER", "Another, to stand beside it", options->other);
    add_option(command, "-o,--output", "FILE", "The page, or - for stdout; default: DIR/report.html", options->output);
    add_option(command, "--frames", "N", "Pictures in the page, at most; default: 60",
               whole(1, options->report.frames));
    add_option(command, "--width", "PIXELS", "Width of its pictures, at most; default: 480",
               whole(16, options->report.width));
}

}  // namespace drape::cli
