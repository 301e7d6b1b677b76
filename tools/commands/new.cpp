// `drape new` writes a first scene to change, one of scene_templates.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "base/printable_text.h"
#include "options.h"
#include "program.h"
#include "scene/nearest_word.h"
#include "scene_templates.h"
#include "streams.h"

namespace drape::cli {

namespace {

const SceneTemplate& template_of(const std::string& name) {
    std::vector<std::string_view> names;
    for (const SceneTemplate& candidate : scene_templates()) {
        if (candidate.name == name) return candidate;
        names.push_back(candidate.name);
    }
    const std::string_view nearest = nearest_word(name, names);
    throw UsageError(fmt::format("new: there is no template '{}': {}", name,
                                 nearest.empty() ? fmt::format("expected one of {}", fmt::join(names, ", "))
                                                 : fmt::format("did you mean '{}'?", nearest)));
}

std::string template_list() {
    std::string text;
    for (const SceneTemplate& each : scene_templates()) text += fmt::format("  {:<9}{}\n", each.name, each.summary);
    return text;
}

ExitCode run(const std::string& name, const std::string& output) {
    const SceneTemplate& scene = template_of(name);
    if (output == "-") {
        print_data(scene.text);
        return ExitCode::ok;
    }
    const std::string path = output.empty() ? name + ".json" : output;
    create_file(path, scene.text);
    print_message(fmt::format("{0}\nNext: drape render {0} -o {1}", printable(path),
                              printable((std::filesystem::path("out") / std::filesystem::path(path).stem()).string())));
    return ExitCode::ok;
}

}  // namespace

void add_new(Program& program) {
    struct Options {
        std::string name, output;
    };
    const auto options = std::make_shared<Options>();
    static const std::string details = "\nTemplates:\n" + template_list() + R"text(
Examples:
  drape new table
  drape new flag -o my_flag.json
  drape new cut -o -
)text";
    CLI::App& command = program.add("new", "Write a first scene to change: table, flag, curtain, ball or cut",
                                    details.c_str(), [=] { return run(options->name, options->output); });
    add_required_file(command, "TEMPLATE", "Which one, of those below", options->name);
    add_option(command, "-o,--output", "FILE",
               "The file, which must not be there yet, or - for stdout; default: TEMPLATE.json", options->output);
}

}  // namespace drape::cli
