#include <fmt/format.h>

#include <algorithm>

#include "base/printable_text.h"
#include "compare/results.h"
#include "options.h"
#include "output/atomic_file.h"
#include "profile/comparison.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    std::string before, after;
    compare::Limits limits;
    bool json = false;
};

ExitCode compare_profiles(const std::string& before, const std::string& after) {
    try {
        const profile::Comparison comparison = profile::compare(read_file(before), before, read_file(after), after);
        print_data(comparison.text());
        return comparison.slower() ? ExitCode::comparison : ExitCode::ok;
    } catch (const profile::NoProfile& error) {
        print_error(printable(error.what()));
        return ExitCode::io;
    }
}

ExitCode run(const CompareOptions& options) {
    const fs::path before = options.before, after = options.after;
    std::error_code ignored;
    for (const fs::path& path : {before, after}) {
        if (fs::exists(path, ignored)) continue;
        throw OutputError(fmt::format("'{}' does not exist", path.string()));
    }
    const bool folder = fs::is_directory(before, ignored);
    if (folder != fs::is_directory(after, ignored)) throw UsageError("a folder is compared with a folder");
    if (!folder && before.extension() != after.extension())
        throw UsageError("'" + options.before + "' and '" + options.after + "' are not of one kind");
    if (!folder && !compare::is_result_file(before)) {
        if (options.json) throw UsageError("--json is of arrays, pictures and folders");
        return compare_profiles(options.before, options.after);
    }
    const std::vector<compare::Row> rows = folder ? compare::compare_folders(before, after, options.limits)
                                                  : compare::compare_files(before, after, options.limits);
    if (rows.empty())
        print_error(printable(fmt::format("nothing to compare: {} that tells of more than times",
                                          folder ? "neither folder has a file" : "neither file has an array")));
    print_data(options.json ? compare::rows_json(rows) : compare::rows_text(rows));
    const bool over = std::ranges::any_of(rows, &compare::Row::over);
    return over || rows.empty() ? ExitCode::comparison : ExitCode::ok;
}

}  // namespace

void add_compare(Program& program) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App& command = program.add("compare", "Two runs' arrays, pictures or folders, or two profiles", R"text(
Arrays (.npy, .npz): largest and RMS difference. Pictures (.png): PSNR and largest difference. Folders: file by file,
those in folders in them too, other files by their bytes; what tells times is left out (manifest.json, results.csv,
jobs/). What is given no limit must be equal. Exit code 7 when anything is over its limit, only one of them has it, or
there is nothing to compare. Where the manifest beside arrays calls frames `sensitive` (equally exact runs part there),
--max and --rms judge the frames before, and of the others only means are told.

Profiles (`drape profile --json`): medians of what both have, their ratio, and the noise: the larger interquartile
range over its median, at least 2 %. Exit code 7 when anything is slower by more than that.

Examples:
  drape compare out/before out/after
  drape compare out/before out/after --max 1e-5 --psnr 40
  drape compare a/positions.npz b/positions.npz --rms 1e-6 --json
  drape compare before.json after.json
)text",
                                    [=] { return run(*options); });
    add_required_file(command, "BEFORE", "A file or a folder", options->before);
    add_required_file(command, "AFTER", "Another of the kind", options->after);
    add_option(command, "--max", "D", "Arrays: largest difference of a value", not_negative(options->limits.largest));
    add_option(command, "--rms", "D", "Arrays: largest RMS of the differences", not_negative(options->limits.rms));
    add_option(command, "--psnr", "DB", "Pictures: least peak signal-to-noise ratio",
               not_negative(options->limits.psnr));
    add_option(command, "--max-channel", "N", "Pictures: largest difference of a colour channel, of 255",
               not_negative(options->limits.channel));
    add_flag(command, "--json", "As JSON on stdout instead of text", options->json);
}

}  // namespace drape::cli
