#include "run/run_description.h"

#include <fmt/format.h>
#include <json/json.h>

#include <map>
#include <sstream>

#include "graph/dump.h"
#include "output/json_text.h"
#include "picture/framing.h"
#include "picture/strain_scale.h"
#include "run/given_values.h"
#include "run/written_colliders.h"
#include "world/start.h"

namespace drape {

namespace {

/// Returns the scene with all changes and defaults, on one line of JSON.
std::string resolved_text(const SceneRequest& request, const LoadedScene& loaded) {
    std::vector<std::string> overrides = request.overrides;
    const ImageSettings& image = loaded.description.image;
    if (request.image_size || request.draft)
        overrides.push_back(fmt::format("/image/size=[{},{}]", image.size[0], image.size[1]));
    if (request.samples || request.draft) overrides.push_back(fmt::format("/image/samples={}", image.samples));
    if (request.motion_blur || request.draft)
        overrides.push_back(fmt::format("/image/motion_blur={}", image.motion_blur));
    std::istringstream text(resolved_scene(loaded.text, overrides, scene_folder(request.path)));
    Json::Value value;
    text >> value;
    return json_line(value);
}

/// Returns the values that the run chose, for readers of its arrays alone.
std::string run_parameters(const SceneDescription& scene, const Manifest& manifest) {
    Json::Value value(Json::objectValue);
    value["program_version"] = manifest.program_version;
    value["device"] = manifest.device.name;
    value["driver"] = manifest.device.driver + " " + manifest.device.driver_version;
    value["scene_hash"] = manifest.scene.hash;
    value["method"] = manifest.solver.method;
    value["kernels"] = manifest.solver.kernels;
    value["substeps"] = manifest.solver.substeps;
    value["iterations"] = manifest.solver.iterations;
    value["tolerance"] = manifest.solver.tolerance;
    value["fps"] = manifest.frames.fps;
    value["frame_step"] = Json::Int64(manifest.frames.step);
    value["overrides"] = value["colliders"] = Json::Value(Json::arrayValue);
    for (const std::string& each : manifest.scene.overrides) value["overrides"].append(each);
    std::map<int, int> counts;
    for (const Collider& collider : scene.colliders)
        value["colliders"].append(
            fmt::format("/colliders/{}/{}", collider_lists[collider.shape.index()], counts[collider.kind()]++));
    return json_line(value);
}

Manifest::Picture picture_of(const SceneDescription& scene, const PictureView& view) {
    const auto& [width, height] = scene.image.size;
    Manifest::Picture picture{width, height, scene.image.samples, {}, 0, {}};
    if (const Camera camera = picture_camera(scene, width, height); camera.keys.empty()) picture.camera = camera;
    picture.motion_blur = scene.image.motion_blur;
    if (view.kind != View::shaded) picture.view = spelling(view_spellings, view.kind);
    if (const auto scale = strain_scale(view, scene)) picture.strain_range = scale->high;
    return picture;
}

}  // namespace

FrameRange frame_range(const RunRequest& request, const SceneDescription& scene, std::vector<std::string>& warnings) {
    const std::uint32_t last = scene.time.frame_count - 1;
    FrameRange range{request.start.value_or(0), request.end.value_or(last), request.step};
    if (range.step == 0) throw UsageError("--step must be at least 1");
    if (range.end > last) {
        warnings.push_back(fmt::format("the scene ends at frame {}: --end {} is clamped", last, range.end));
        range.end = last;
    }
    if (range.start > range.end)
        throw UsageError(
            fmt::format("no frame to write: --start {} is after the last frame {}", range.start, range.end));
    return range;
}

Manifest describe_run(const RunRequest& request, const LoadedScene& loaded, const Simulation& simulation,
                      const DeviceInfo& device, const FrameRange& range) {
    const SceneDescription& scene = simulation.scene();
    const SimulationFacts facts = simulation.facts();
    Manifest manifest;
    manifest.program_version = program_version();
    manifest.program_commit = program_commit();
    manifest.scene = {request.scene.path, scene.name, loaded.hash, request.scene.overrides};
    manifest.device = {device.name, device.driver, device.driver_version, device.api_version, device.uuid_text()};
    manifest.frames = {range.start, range.end, range.step, range.count(), scene.time.fps};
    if (request.draws() || request.layers()) manifest.picture = picture_of(scene, request.scene.view);
    const bool chosen = facts.asked_method != facts.method;
    manifest.solver = {facts.method,
                       facts.kernels,
                       scene.solver.substeps,
                       scene.solver.iterations,
                       scene.solver.tethers,
                       chosen ? facts.asked_method : "",
                       facts.choice_reason,
                       scene.solver.tolerance,
                       {}};
    for (const SimulationFacts::Skipped& skipped : facts.skipped)
        manifest.skipped.push_back({skipped.what, skipped.reason});
    for (const Compromise& each : facts.compromises)
        manifest.compromises.push_back({each.what, each.reason, each.enough_substeps});
    manifest.momenta = facts.momenta;
    manifest.created = utc_timestamp();
    manifest.command_line = request.command_line;
    return manifest;
}

WrittenRun written_run(const RunRequest& request, const LoadedScene& loaded, const Simulation& simulation,
                       const Manifest& manifest) {
    const SceneDescription& scene = simulation.scene();
    WrittenRun run;
    run.start = static_cast<std::uint32_t>(manifest.frames.start);
    run.end = static_cast<std::uint32_t>(manifest.frames.end);
    run.step = static_cast<std::uint32_t>(manifest.frames.step);
    run.fps = scene.time.fps;
    run.cuts = scene.comes_apart();
    run.fields = scene.force_fields;
    run.width = scene.image.size[0], run.height = scene.image.size[1];
    run.alpha = scene.image.alpha;
    run.deflates = request.deflates;
    run.key = manifest.run_key;
    run.seed = scene.wind.gust.seed;
    run.set = set_arrays(manifest.scene.overrides);
    run.up = scene.up;
    run.colliders = written_colliders(scene, run.bodies);
    run.obstacles = written_obstacles(scene, run.bodies);
    if (request.details()) {
        run.scene = resolved_text(request.scene, loaded);
        run.parameters = run_parameters(scene, manifest);
    }
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
        const Cloth& description = scene.cloths[cloth];
        run.cloths.push_back({scene.cloths.size() == 1 ? "" : description.name, description.grid[0],
                              description.grid[1], simulation.triangles(cloth), description.name, description.size,
                              held_at_start(description), scene.up, description.panel,
                              run.cuts || run.fields ? simulation.spring_bits(cloth) : std::vector<std::uint8_t>()});
    }
    return run;
}

std::vector<std::string> notes(const Device& device, const Simulation& simulation) {
    const DeviceInfo& info = device.info();
    const SceneDescription& scene = simulation.scene();
    const SimulationFacts facts = simulation.facts();
    std::uint64_t particle_count = 0;
    for (const Cloth& cloth : scene.cloths) particle_count += std::uint64_t{cloth.grid[0]} * cloth.grid[1];
    return {
        fmt::format("device {}: {} ({}), driver {} {}, Vulkan {}, UUID {}", info.index, info.name, info.type,
                    info.driver, info.driver_version, info.api_version, info.uuid_text()),
        fmt::format("scene: {} cloth{}, {} particles, {} substeps x {} iterations", scene.cloths.size(),
                    scene.cloths.size() == 1 ? "" : "s", particle_count, scene.solver.substeps,
                    scene.solver.iterations),
        fmt::format("solver: {}{}", facts.method, facts.asked_method != facts.method ? ": " + facts.choice_reason : ""),
        fmt::format("plan: {} passes, {} barriers in a frame that is written, {} passes, {} barriers in one that is "
                    "only simulated; `drape graph` lists them, and what was skipped",
                    facts.pass_count, facts.barrier_count, facts.simulated_pass_count, facts.simulated_barrier_count),
        fmt::format("device memory: {} of at most {}", graph::size_text(device.memory_used()),
                    graph::size_text(device.memory_limit()))};
}

}  // namespace drape
