// The `drape` command: parses the command line, says what went wrong, returns the documented exit code.
#include "commands.h"
#include "options.h"
#include "streams.h"

namespace {

using drape::ExitCode;
using drape::RunRequest;
using drape::SceneRequest;

constexpr const char* main_examples = R"text(
Examples:
  drape check scenes/*.json
  drape render scenes/flag.json -o out/flag
  drape simulate scenes/hanging_sheet.json -o out/hang
  drape graph scenes/flag.json --format dot | dot -Tsvg > flag.svg
  drape bench accuracy --short
`drape COMMAND --help` has each command's options and examples.
)text";

constexpr const char* render_examples = R"text(
Writes frame_0000.png ... (8-bit sRGB) and, last, manifest.json: a folder that has one is done.

Examples:
  drape render scenes/cloth_on_sphere.json -o out/sphere
  drape render scenes/flag.json -o out/flag -s 60 -e 120 -j 10 --size 640x360
  drape render scenes/flag.json -o out/calm --set '/wind/velocity=[1,0,0]' --set /solver/substeps=40
  drape render scenes/flag.json -o out/flag --resume          after an interruption
  ffmpeg -framerate 60 -i out/flag/frame_%04d.png -pix_fmt yuv420p flag.mp4
)text";

constexpr const char* simulate_examples = R"text(
Writes positions.npy, or positions_CLOTH.npy for each of several cloths, or what --export asks for, named likewise;
and, last, manifest.json. When a position is no longer finite the run ends with exit code 5; the files then hold
the frames before.

Examples:
  drape simulate scenes/hanging_sheet.json -o out/hang
  drape simulate scenes/flag.json -o out/flag -s 60 -j 2 -q
  drape simulate scenes/flag.json -o out/flag --export pc2,npz
  python3 -c "import numpy; print(numpy.load('out/hang/positions.npy').shape)"
)text";

constexpr const char* graph_examples = R"text(
Examples:
  drape graph scenes/flag.json
  drape graph scenes/flag.json --simulate --format json
  drape graph scenes/flag.json --format dot | dot -Tsvg > flag.svg
)text";

constexpr const char* check_examples = R"text(
Errors read file:line:column: /json/pointer: message.

Examples:
  drape check scenes/*.json
  drape check my.json --set /solver/substeps=40 --json
)text";

constexpr const char* accuracy_examples = R"text(
Runs reference problems by every solver at many settings and compares with closed forms and converged
double-precision solutions. On stdout a table of errors and times, fitted orders of convergence, limits met, and
which solver meets an error soonest. Times are the device's, of the simulation alone: medians over repetitions.
The full benchmark takes hours on a CPU, references included; SIGINT ends it, and the same command goes on.

Examples:
  drape bench accuracy --short --svg out/plots
  drape bench accuracy --filter '^(swing|drum)/(64|128)/' --json out/swing.json
  drape bench accuracy --budget 120 --json out/accuracy.json --csv out/accuracy.csv --svg out/plots
)text";

/// What the command line asks for, and what came of it.
struct CommandLine {
    RunRequest render, simulate;
    SceneRequest graph_scene;
    std::string graph_format = "text";
    bool graph_simulate = false;
    std::vector<std::string> check_paths, check_overrides;
    drape::bench::AccuracyRequest accuracy;
    bool check_json = false, check_quiet = false, devices_json = false;
    ExitCode code = ExitCode::ok;
};

std::string footer(const char* text) {
    return text +
           std::string("\nData goes to stdout, messages to stderr. `drape --help` says what each exit code means.\n") +
           "Exit codes: " + drape::exit_code_list(98) + ".\n";
}

void add_runs(CLI::App& app, CommandLine& line) {
    CLI::App* command = app.add_subcommand("render", "Simulate a scene and draw it: PNG files and manifest.json");
    command->footer(footer(render_examples));
    drape::cli::add_run_options(*command, line.render);
    drape::cli::add_image_options(*command, line.render.scene);
    command->callback([&line] { line.code = drape::cli::run(line.render); });

    line.simulate.formats = {"npy"};
    command = app.add_subcommand("simulate", "Simulate a scene without drawing: positions and meshes");
    command->footer(footer(simulate_examples));
    drape::cli::add_run_options(*command, line.simulate);
    command->callback([&line] { line.code = drape::cli::run(line.simulate); });
}

void add_graph(CLI::App& app, CommandLine& line) {
    CLI::App* command = app.add_subcommand("graph", "Print what runs in a frame, what was skipped, and why");
    command->footer(footer(graph_examples));
    drape::cli::add_scene_options(*command, line.graph_scene);
    drape::cli::add_image_options(*command, line.graph_scene);
    const auto check_format = [](const std::string& text) {
        return text == "text" || text == "json" || text == "dot" ? std::string()
                                                                 : "expected text, json or dot, got '" + text + "'";
    };
    command->add_option("--format", line.graph_format, "text, json or dot (for Graphviz); default: text")
        ->type_name("FORMAT")
        ->check(check_format, "");
    command->add_flag("--simulate", line.graph_simulate, "As `drape simulate` runs it: nothing is drawn");
    command->callback(
        [&line] { line.code = drape::cli::graph(line.graph_scene, !line.graph_simulate, line.graph_format); });
}

void add_checks(CLI::App& app, CommandLine& line) {
    CLI::App* command = app.add_subcommand("check", "Check scene files; needs no device");
    command->footer(footer(check_examples));
    command->add_option("SCENE", line.check_paths, "Scene files")->required()->type_name("");
    drape::cli::add_override_option(*command, line.check_overrides);
    command->add_flag("--json", line.check_json, "Errors and warnings as JSON on stdout");
    command->add_flag("-q,--quiet", line.check_quiet, "Say nothing about good files");
    command->callback([&line] {
        line.code = drape::cli::check(line.check_paths, line.check_overrides, line.check_json, line.check_quiet);
    });

    command = app.add_subcommand("schema", "Print the JSON Schema (draft-07) of scene files, with every default");
    command->footer(footer("\nExample:\n  drape schema > scene.schema.json\n"));
    command->callback([&line] { line.code = drape::cli::schema(); });

    command = app.add_subcommand("devices", "List the Vulkan devices, and why one cannot be used");
    command->footer(footer("\nExample:\n  drape devices --json\n"));
    command->add_flag("--json", line.devices_json, "As JSON");
    command->callback([&line] { line.code = drape::cli::devices(line.devices_json); });
}

void add_bench(CLI::App& app, CommandLine& line) {
    CLI::App* bench = app.add_subcommand("bench", "Measure every solver: `drape bench accuracy`, error against work");
    bench->require_subcommand(1);
    bench->footer(footer("\nExample:\n  drape bench accuracy --short\n"));
    CLI::App* command = bench->add_subcommand("accuracy", "Error against time, substeps, iterations and size");
    command->footer(footer(accuracy_examples));
    drape::cli::add_accuracy_options(*command, line.accuracy);
    command->callback([&line] { line.code = drape::cli::bench_accuracy(line.accuracy); });
}

/// Says what is wrong with the command line, and where help is.
int usage_error(const CLI::App& app, const std::string& text) {
    std::string name = "drape";
    for (const CLI::App* command = &app; !command->get_subcommands().empty();) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    drape::cli::print_message(name + ": " + text + "\nSee `" + name + " --help`.");
    return static_cast<int>(ExitCode::usage);
}

/// Empty when `name` is a command, else the names of all.
std::string other_commands(const CLI::App& app, const std::string& name) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) return {};
        names += (names.empty() ? "" : ", ") + command->get_name();
    }
    return names;
}

int run_command_line(int argc, char** argv, CLI::App& app) {
    const std::string first = argc < 2 ? "" : argv[1];
    if (!first.starts_with('-')) {
        const std::string commands = other_commands(app, first);
        if (!commands.empty())
            return usage_error(app, (first.empty() ? "no command given" : "unknown command '" + first + "'") +
                                        ": expected one of " + commands);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        drape::cli::print_data(app.help());
    } catch (const CLI::CallForVersion& version) {
        drape::cli::print_data(std::string(version.what()) + "\n");
    } catch (const CLI::ParseError& error) {
        return usage_error(app, error.what());
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    drape::cli::prepare_streams();
    CommandLine line;
    line.render.command_line = line.simulate.command_line = {argv, argv + argc};
    try {
        CLI::App app{"drape: cloth simulation on the GPU (Vulkan compute); scene file in, PNG sequence out.", "drape"};
        app.set_version_flag("--version", std::string("drape ") + drape::program_version());
        app.require_subcommand(1);
        app.footer(std::string(main_examples) + "\nData goes to stdout, messages to stderr. Exit codes:\n" +
                   drape::exit_code_table());
        add_runs(app, line);
        add_graph(app, line);
        add_checks(app, line);
        add_bench(app, line);
        const int usage = run_command_line(argc, argv, app);
        return usage != 0 ? usage : static_cast<int>(line.code);
    } catch (...) {
        return static_cast<int>(drape::cli::report_current_exception());
    }
}
