#include <json/json.h>

#include "base/printable_text.h"
#include "cloth/simulation_model.h"
#include "options.h"
#include "output/json_text.h"
#include "output/slow_notice.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct CheckOptions {
    std::vector<std::string> paths, overrides;
    bool json = false, quiet = false;
};

Json::Value json_error(const SceneError& error) {
    Json::Value value(Json::objectValue);
    value["file"] = error.file;
    value["line"] = error.line;
    value["column"] = error.column;
    value["pointer"] = error.pointer;
    value["message"] = error.message;
    return value;
}

/// Returns what a good scene's method follows only in part. The choice of `auto` depends on the device, so it has none.
std::vector<Compromise> known_compromises(const SceneResult& result) {
    if (!result.scene || result.scene->solver.method == SolverMethod::automatic) return {};
    return SimulationModel(*result.scene).compromises();
}

/// Prints every error of every file on stderr, or as JSON on stdout.
ExitCode check(const CheckOptions& options) {
    ExitCode code = ExitCode::ok;
    Json::Value report(Json::arrayValue);
    for (const std::string& path : scene_files(options.paths)) {
        const SlowNotice notice(printable(path) + ": still being read and checked ...", print_message);
        const SceneResult result = read_scene(path, options.overrides);
        if (!result.scene) code = result.unreadable || code == ExitCode::io ? ExitCode::io : ExitCode::scene;
        Json::Value row(Json::objectValue);
        row["file"] = path;
        row["ok"] = result.scene.has_value();
        row["errors"] = row["warnings"] = Json::Value(Json::arrayValue);
        for (const SceneError& error : result.errors) {
            row["errors"].append(json_error(error));
            if (!options.json) print_message(error.text());
        }
        for (const SceneError& warning : result.warnings) {
            row["warnings"].append(json_error(warning));
            if (!options.json) print_message("warning: " + warning.text());
        }
        row["compromises"] = Json::Value(Json::arrayValue);
        for (const Compromise& each : known_compromises(result)) {
            Json::Value& entry = row["compromises"].append(Json::Value(Json::objectValue));
            entry["what"] = each.what;
            entry["reason"] = each.reason;
            if (!options.json) print_message("warning: " + printable(path) + ": " + each.what + ": " + each.reason);
        }
        report.append(row);
        if (!options.json && !options.quiet && result.scene) print_data(printable(path) + ": ok\n");
    }
    if (options.json) print_data(json_text(report));
    return code;
}

}  // namespace

void add_check(Program& program) {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App& command = program.add("check", "Check scene files; needs no device", R"text(
Errors read file:line:column: /json/pointer: message.

Examples:
  drape check scenes/*.json
  drape check scenes             every .json file in the folder
  drape check my.json --set /solver/substeps=40 --json
)text",
                                    [=] { return check(*options); });
    add_scene_list(command, options->paths);
    add_override_option(command, options->overrides);
    add_flag(command, "--json", "Errors, warnings and compromises as JSON on stdout", options->json);
    add_flag(command, "-q,--quiet", "Say nothing about good files", options->quiet);
}

}  // namespace drape::cli
