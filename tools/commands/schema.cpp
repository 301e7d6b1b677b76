#include "drape/scene_reader.h"
#include "options.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

void add_schema(Program& program) {
    const auto markdown = std::make_shared<bool>(false);
    const auto run = [=] {
        print_data(*markdown ? scene_format_markdown() : scene_schema());
        return ExitCode::ok;
    };
    CLI::App& command = program.add("schema", "Print the JSON Schema (draft-07) of scene files, with every default",
                                    "\nExample:\n  drape schema > scene.schema.json\n", run);
    add_flag(command, "--markdown", "The format for readers, as Markdown", *markdown);
}

}  // namespace drape::cli
