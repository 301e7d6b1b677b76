#include <fmt/format.h>

#include <filesystem>

#include "base/printable_text.h"
#include "options.h"
#include "output/atomic_file.h"
#include "program.h"
#include "report/run_report.h"
#include "report/sweep_report.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct ReportOptions {
    std::string folder, other, output;
    report::ReportOptions report;
};

std::string page(const ReportOptions& options) {
    if (report::is_sweep_folder(options.folder)) {
        if (!options.other.empty()) throw UsageError("report: a sweep's page has no other beside it");
        return report::sweep_html(options.folder);
    }
    std::vector<report::RunFolder> runs{report::read_run_folder(options.folder)};
    if (!options.other.empty()) runs.push_back(report::read_run_folder(options.other));
    return report::report_html(runs, options.report);
}

ExitCode run(const ReportOptions& options) {
    const std::string html = page(options);
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
    CLI::App& command = program.add("report", "One HTML page of a run or a sweep: 3-D, pictures, plots, times", R"text(
The page needs no network and no other file: the cloth in 3-D, to turn and play,
where the run exported npz; pictures shrunk, as a player and a contact sheet;
stretch, energy, penetration and substeps over time; times by stage; settings
and warnings. With two folders both stand side by side. Of a run that goes on or
was killed the page has what its pictures tell; of a sweep, a line per run.

Examples:
  drape report out/flag
  drape report out/flag out/calm -o compared.html
)text",
                                    [=] { return run(*options); });
    add_required_file(command, "DIR", "Folder of a run or a sweep", options->folder);
    add_optional_file(command, "OTHER", "Another, to stand beside it", options->other);
    add_option(command, "-o,--output", "FILE", "The page, or - for stdout; default: DIR/report.html", options->output);
    add_option(command, "--frames", "N", "Pictures in the page, at most; default: 60",
               whole(1, options->report.frames));
    add_option(command, "--width", "PIXELS", "Width of its pictures, at most; default: 480",
               whole(16, options->report.width));
    add_option(command, "--positions", "MB", "Megabytes of a run's positions, at most, for 3-D; default: 8",
               number("megabytes", 0, 1000, [=](double value) { options->report.megabytes = value; }));
}

}  // namespace drape::cli
