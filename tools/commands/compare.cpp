#include <fstream>
#include <sstream>

#include "options.h"
#include "output/output_error.h"
#include "profile/comparison.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw OutputError("cannot read '" + path + "'");
    return text.str();
}

ExitCode run(const std::string& before, const std::string& after) {
    try {
        const profile::Comparison comparison = profile::compare(text_of(before), before, text_of(after), after);
        print_data(comparison.text());
        return comparison.slower() ? ExitCode::comparison : ExitCode::ok;
    } catch (const profile::NoProfile& error) {
        print_error(error.what());
        return ExitCode::io;
    }
}

}  // namespace

void add_compare(Program& program) {
    struct Files {
        std::string before, after;
    };
    const auto files = std::make_shared<Files>();
    CLI::App& command = program.add("compare", "Two profiles against their noise", R"text(
Medians of what both profiles (`drape profile --json`) have, their ratio, and the noise: the larger interquartile range
over its median, at least 2 %. Exit code 7 when anything is slower by more than that.

Example:
  drape compare before.json after.json
)text",
                                    [=] { return run(files->before, files->after); });
    add_required_file(command, "BEFORE", "A profile", files->before);
    add_required_file(command, "AFTER", "Another", files->after);
}

}  // namespace drape::cli
