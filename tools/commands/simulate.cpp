#include "commands/run_command.h"
#include "options.h"
#include "program.h"

namespace drape::cli {

void add_simulate(Program& program) {
    const auto request = std::make_shared<RunRequest>();
    request->formats = {"npy", "npz"};
    const auto run = [=, &program] { return run_into_folder(*request, program.arguments()); };
    CLI::App& command = program.add("simulate", "Simulate a scene without drawing: positions and meshes", R"text(
Writes positions.npy and positions.npz (positions_CLOTH.npy and so on for each of several cloths), or what --export asks
for, named likewise; and, last, manifest.json. When a position is no longer finite the run ends with exit code 5; the
files then hold the frames before.

Examples:
  drape simulate scenes/hanging_sheet.json -o out/hang
  drape simulate scenes/flag.json -o out/flag -s 60 -j 2 -q
  drape simulate scenes/flag.json -o out/flag --export pc2,usda
  python3 -c "import numpy; run = numpy.load('out/hang/positions.npz'); \
      print(run['velocities'].shape)"
)text",
                                    run);
    add_run_options(command, *request);
}

}  // namespace drape::cli
