// `drape pattern` makes a scene of a sewing pattern (scene/sewing_pattern.h).
#include <fmt/format.h>

#include <filesystem>

#include "base/printable_text.h"
#include "drape/fabric.h"
#include "options.h"
#include "program.h"
#include "scene/sewing_pattern.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct Options {
    std::string path, output, body;
    PatternOptions pattern;
};

ExitCode run(Options options) {
    if (!options.body.empty()) options.pattern.bodies = {options.body};
    const PatternResult result = read_sewing_pattern(options.path, options.pattern);
    for (const SceneError& error : result.errors) print_message(error.text());
    if (!result.errors.empty()) return result.unreadable ? ExitCode::io : ExitCode::scene;
    if (options.output == "-") {
        print_data(result.scene);
        return ExitCode::ok;
    }
    const std::string path =
        options.output.empty() ? std::filesystem::path(options.path).stem().string() + "_scene.json" : options.output;
    create_file(path, result.scene);
    if (result.metres_per_unit)
        print_message(fmt::format("A unit of the texture is {:.4g} m.", *result.metres_per_unit));
    print_message(
        fmt::format("{0}: {1} panels, {2} seams\nNext: drape check {0}", printable(path), result.panels, result.seams));
    return ExitCode::ok;
}

}  // namespace

void add_pattern(Program& program) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        program.add("pattern", "Make a scene of a sewing pattern: GarmentCode's JSON, or a mesh with flat islands",
                    R"text(
Every panel becomes a cloth with an outline, every stitch a seam, which draws its sides together. Of a mesh (.obj) every
island of its texture becomes a panel; what is one on the mesh is sewn. Gravity comes when it is done. The scene is
there to go on with: colors, contact, and pins where nothing holds the clothes.

Examples:
  drape pattern t_shirt.json --body figure.obj -o my_t_shirt.json
  drape pattern t_shirt.json --spacing 0.02 --fabric jersey -o -
)text",
                    [=] { return run(*options); });
    add_required_file(command, "PATTERN", "The pattern: a JSON file, or an .obj file with texture vertices",
                      options->path);
    add_option(command, "-o,--output", "FILE",
               "The scene, which must not be there yet, or - for stdout; default: PATTERN_scene.json", options->output);
    add_option(command, "--spacing", "METRES", "Between particles, about; default: 0.015",
               number("metres above 0", above_zero, 1e3, [=](double value) { options->pattern.spacing = value; }));
    add_option(command, "--close", "SECONDS", "In which the seams are drawn together; default: 1",
               number("seconds, 0 or more", 0, 1e4, [=](double value) { options->pattern.close = value; }));
    std::vector<std::string> names;
    for (const Fabric& fabric : fabrics) names.emplace_back(fabric.name);
    add_choice(command, "--fabric", names, "What all panels are of; default: cotton",
               [=](std::size_t place) { options->pattern.fabric = fabrics[place].name; });
    add_option(command, "--body", "FILE", "A closed mesh in metres, as the scene is to name it, that wears them",
               options->body);
}

}  // namespace drape::cli
