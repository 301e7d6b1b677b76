#include "commands/run_command.h"
#include "options.h"
#include "program.h"

namespace drape::cli {

void add_render(Program& program) {
    const auto request = std::make_shared<RunRequest>();
    const auto run = [=, &program] { return run_into_folder(*request, program.arguments()); };
    CLI::App& command = program.add("render", "Simulate a scene and draw it: PNG files and manifest.json", R"text(
Writes frame_0000.png ... (8-bit sRGB) and, last, manifest.json: a folder that has one has ended, as
its "status" says.

Examples:
  drape render scenes/cloth_on_sphere.json -o out/sphere
  drape render scenes/flag.json -o out/flag -s 60 -e 120 -j 10 --size 640x360
  drape render scenes/flag.json -o out/calm --set '/wind/velocity=[1,0,0]'
  drape render scenes/flag.json -o out/flag --resume    after an interruption
  drape render scenes/flag.json -o out/stretch --view stretch --view-range 5
  ffmpeg -framerate 60 -pattern_type glob -i 'out/flag/frame_*.png' \
      -vf 'pad=2*ceil(iw/2):2*ceil(ih/2)' -pix_fmt yuv420p flag.mp4
  drape render scenes/flag.json -o - | ffmpeg -i - -colorspace bt709 \
      -color_primaries bt709 -color_trc bt709 flag.mp4
)text",
                                    run);
    add_run_options(command, *request);
    add_image_options(command, request->scene);
}

}  // namespace drape::cli
