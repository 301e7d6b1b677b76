#include "program.h"
#include "scene/scene_reader.h"
#include "streams.h"

namespace drape::cli {

void add_schema(Program& program) {
    const auto run = [] {
        print_data(scene_schema());
        return ExitCode::ok;
    };
    program.add("schema", "Print the JSON Schema (draft-07) of scene files, with every default",
                "\nExample:\n  drape schema > scene.schema.json\n", run);
}

}  // namespace drape::cli
