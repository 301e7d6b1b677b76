// The `drape` command: parses the command line, says what went wrong, returns the documented exit code.
#include <CLI/CLI.hpp>

#include "commands.h"

namespace {

using drape::ExitCode;
using drape::RunRequest;
using drape::SceneRequest;

constexpr const char* footer = R"(
Exit codes: 0 ok, 1 file or folder, 2 usage, 3 scene, 4 device, 5 diverged, 6 validation message,
7 comparison over its limit, 8 tolerance not reachable, 130/143 stopped by SIGINT/SIGTERM.

Examples:
  drape render scenes/cloth_on_sphere.json -o out/sphere
  drape render scenes/flag.json -o out/flag -s 60 -e 120 -j 10 --size 640x360
  drape render scenes/flag.json -o out/calm --set /wind/velocity='[1,0,0]' --set /solver/substeps=40
  drape simulate scenes/hanging_sheet.json -o out/hang --export npy
  drape graph scenes/flag.json --format dot | dot -Tsvg > flag.svg
  drape check scenes/*.json
)";

void add_scene_options(CLI::App& command, SceneRequest& scene) {
    command.add_option("SCENE", scene.path, "Scene file (JSON; `drape schema` prints its schema)")->required();
    command.add_option("--set", scene.overrides, "Override a value: /json/pointer=value (repeatable)")
        ->allow_extra_args(false);
    command.add_option("--device", scene.device, "INDEX, NAME, UUID or cpu; default: a GPU when there is one");
    command.add_flag("--validate", scene.validate,
                     "Core and synchronization validation; exit code 6 when there was a message");
    command.add_flag("!--no-skip", scene.skip, "Keep the work of the exact skips (it changes no result bit)");
}

std::array<std::uint32_t, 2> parse_size(const std::string& text) {
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) != 2 || width < 1 || height < 1 ||
        width > 16384 || height > 16384)
        throw CLI::ValidationError("--size", "expected WIDTHxHEIGHT, 1 to 16384 each, got '" + text + "'");
    return {width, height};
}

void add_image_options(CLI::App& command, SceneRequest& scene) {
    command.add_option_function<std::string>(
        "--size", [&scene](const std::string& text) { scene.image_size = parse_size(text); }, "Image size, WIDTHxHEIGHT");
    command.add_option("--samples", scene.samples, "Samples per pixel")->check(CLI::IsMember({1u, 4u}));
}

void add_run_options(CLI::App& command, RunRequest& request) {
    add_scene_options(command, request.scene);
    command.add_option("-o,--output", request.output, "Folder for the results; must be empty or not there")->required();
    command.add_option("-s,--start", request.start, "First frame written (default 0, the initial state)");
    command.add_option("-e,--end", request.end, "Last frame written, inclusive (default: the scene's last)");
    command.add_option("-j,--step", request.step, "Write every N-th frame")->check(CLI::PositiveNumber);
    command.add_flag_callback("--overwrite", [&request] { request.existing = drape::ExistingFiles::overwrite; },
                              "Replace what an earlier run wrote there; other files stay");
    command.add_flag("-q,--quiet", request.quiet, "No progress, errors only");
}

std::vector<std::string> arguments(int argc, char** argv) { return {argv, argv + argc}; }

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"drape: cloth simulation on the GPU (Vulkan compute); scene file in, PNG sequence out.", "drape"};
    app.set_version_flag("--version", std::string("drape ") + drape::program_version());
    app.require_subcommand(1);
    app.footer(footer);
    ExitCode code = ExitCode::ok;

    RunRequest render;
    CLI::App* command = app.add_subcommand("render", "Simulate and draw a scene: frame_0000.png ... and manifest.json");
    add_run_options(*command, render);
    add_image_options(*command, render.scene);
    command->callback([&] { code = drape::cli::run(render); });

    RunRequest simulate;
    simulate.draw = false;
    std::vector<std::string> exports{"npy"};
    command = app.add_subcommand("simulate", "Simulate without drawing; positions as arrays");
    add_run_options(*command, simulate);
    command->add_option("--export", exports, "What to write: npy (float32 [frame, row, column, 3], metres)")
        ->delimiter(',')
        ->check(CLI::IsMember({"npy"}));
    command->callback([&] {
        simulate.export_npy = true;
        code = drape::cli::run(simulate);
    });

    SceneRequest graph_scene;
    std::string format = "text";
    bool without_raster = false;
    command = app.add_subcommand("graph", "Print what runs in a frame, what was skipped, and why");
    add_scene_options(*command, graph_scene);
    add_image_options(*command, graph_scene);
    command->add_option("--format", format, "text, json or dot")->check(CLI::IsMember({"text", "json", "dot"}));
    command->add_flag("--simulate", without_raster, "As `drape simulate` runs it: no raster");
    command->callback([&] { code = drape::cli::graph(graph_scene, !without_raster, format); });

    std::vector<std::string> paths, overrides;
    bool json = false, quiet = false;
    command = app.add_subcommand("check", "Check scene files; prints every error with its place");
    command->add_option("SCENE", paths, "Scene files")->required();
    command->add_option("--set", overrides, "Override a value: /json/pointer=value")->allow_extra_args(false);
    command->add_flag("--json", json, "Errors and warnings as JSON on stdout");
    command->add_flag("-q,--quiet", quiet, "Say nothing about good files");
    command->callback([&] { code = drape::cli::check(paths, overrides, json, quiet); });

    app.add_subcommand("schema", "Print the JSON Schema of scene files")->callback([&] { code = drape::cli::schema(); });

    bool devices_json = false;
    command = app.add_subcommand("devices", "List the Vulkan devices");
    command->add_flag("--json", devices_json, "As JSON");
    command->callback([&] { code = drape::cli::devices(devices_json); });

    drape::cli::catch_signals();
    render.command_line = simulate.command_line = arguments(argc, argv);
    render.stop = simulate.stop = [] { return drape::cli::caught_signal() != 0; };
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    } catch (...) {
        return static_cast<int>(drape::cli::report_current_exception());
    }
    return static_cast<int>(code);
}
