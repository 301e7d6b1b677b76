#include "bench/benchmarks.h"
#include "commands/bench_options.h"

namespace drape::cli {

void add_bench_fabric(Program& program) {
    const auto request = std::make_shared<bench::FabricRequest>();
    CLI::App& command = program.add(
        "bench fabric", "How the fabrics drape, beside what was measured",
        R"text(
Of every fabric: its drape as Cusick measures it, that is the shadow of a round
cloth of 30 cm that is clamped between discs of 18 cm (the share of the free
ring's area), and its folds, on grids of 65 and 97 particles a side that are
turned by 0, 22.5 and 45 degrees; its bending length, as Peirce's cantilever
measures it, beside that of its rigidity; the modulus of a strip that is cut at
45 degrees.

Examples:
  drape bench fabric --fabric silk --grid 33
)text",
        [=] { return run_benchmark(*request, "nothing was written", [=] { return bench::run_fabric(*request); }); });
    add_option(command, "--fabric", "NAME", "This fabric alone; default: all", request->fabric);
    add_option(command, "--grid", "N", "Particles a side; default: 65 and 97", whole(9, request->grid));
    add_bench_options(command, *request);
}

}  // namespace drape::cli
