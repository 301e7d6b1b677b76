#include <CLI/CLI.hpp>

#include "options.h"
#include "program.h"
#include "solver/step_row.h"
#include "streams.h"

namespace drape::cli {

void add_graph(Program& program) {
    struct Options {
        SceneRequest scene;
        std::string format = "text";
        bool simulate = false, steps = false;
    };
    const auto options = std::make_shared<Options>();
    const auto run = [=] {
        if (options->steps) {
            print_data(step_document());
            return ExitCode::ok;
        }
        if (options->scene.path.empty()) throw UsageError("SCENE is required");
        print_data(describe_graph(options->scene, !options->simulate, options->format));
        return ExitCode::ok;
    };
    CLI::App& command = program.add("graph", "Print what runs in a frame, what was skipped, and why", R"text(
As one device runs it; where a second one draws (as in `render` on a CPU), the same passes are two
graphs, joined by a readback and an upload of positions.

Examples:
  drape graph scenes/flag.json
  drape graph scenes/flag.json --simulate --format json
  drape graph --steps
  drape graph scenes/flag.json --format dot | dot -Tsvg > flag.svg
)text",
                                    run);
    add_scene_options(command, options->scene);
    command.get_option("SCENE")->required(false);
    add_image_options(command, options->scene);
    const std::vector<std::string> formats{"text", "json", "dot"};
    add_choice(command, "--format", formats, "dot is for Graphviz; default: text",
               [=](std::size_t place) { options->format = formats[place]; });
    add_flag(command, "--steps", "What the shader of every step reads and writes, as Markdown; needs no SCENE",
             options->steps);
    add_flag(command, "--simulate", "As `drape simulate` runs it: nothing is drawn", options->simulate);
}

}  // namespace drape::cli
