// `drape camera` runs a scene to see where a camera has to stand (picture/framing.h).
#include <fmt/format.h>

#include <algorithm>

#include "drape/simulation.h"
#include "ending.h"
#include "options.h"
#include "picture/framing.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct Options {
    SceneRequest scene;
    std::uint32_t start = 0;
    std::optional<std::uint32_t> end;
};

std::string listed(const Vec3& point) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", point[0], point[1], point[2]); }

ExitCode run(const Options& options) {
    catch_signals();
    const Device device(options.scene.device, validation_if(options.scene.validate));
    Simulation simulation(asked_scene(options.scene), simulation_options(options.scene, false, true, false), device);
    const SceneDescription& scene = simulation.scene();
    const std::uint32_t most = scene.time.frame_count - 1, last = std::min(options.end.value_or(most), most);
    if (options.start > last)
        throw UsageError(fmt::format("no frame to see: --start {} is after the last frame {}", options.start, last));
    const auto [width, height] = scene.image.size;
    Framing framing(scene, static_cast<double>(width) / height);
    const auto from_start = [&](std::uint32_t frame) { return frame >= options.start; };
    const auto add = [&](const FinishedFrame& frame) { framing.add(scene, frame); };
    if (!simulation.run(last, from_start, add, stop_requested)) return report_stop("no camera was found");
    const Camera camera = framing.camera().value();  // a scene has a cloth, and the range a frame
    print_data(fmt::format("{{\"position\": {}, \"target\": {}, \"fov\": {:g}}}\n", listed(camera.position),
                           listed(camera.target), camera.fov));
    if (device.validation_count() > 0) return report_validation(device.validation_count());
    return ExitCode::ok;
}

}  // namespace

void add_camera(Program& program) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = program.add("camera", "Find the camera that shows all of a scene's motion", R"text(
Simulates the scene without drawing, and prints the nearest camera whose pictures hold every cloth, and every collider
with an end, in each frame, a tenth of the picture free around them. It looks as the scene's own camera does at the
start, under the same angle; without one, from the right, the front and above.

Examples:
  drape camera scenes/flag.json
  drape camera scenes/flag.json --size 720x1280
  drape render scenes/flag.json -o out/fits \
      --set "/camera=$(drape camera scenes/flag.json)"
)text",
                                    [=] { return run(*options); });
    add_scene_options(command, options->scene);
    add_size_option(command, options->scene);
    add_option(command, "-s,--start", "FRAME", "The first that counts; default: 0", whole(0, options->start));
    add_option(command, "-e,--end", "FRAME", "The last one; default, and at most: the scene's last",
               whole(0, options->end));
}

}  // namespace drape::cli
