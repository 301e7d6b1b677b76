#include "run/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/mesh_sequence.h"
#include "output/kept_frames.h"
#include "run/frame_sink.h"
#include "spirv_modules.h"
#include "world/contact_shape.h"

namespace drape {

namespace {

/// Returns the hash of what the cloth has from files, whatever they are called.
std::string given_hash(const Cloth& cloth) {
    return xxh3_128_hex(std::as_bytes(std::span(cloth.start))) +
           (cloth.velocities.empty() ? "" : xxh3_128_hex(std::as_bytes(std::span(cloth.velocities)))) +
           xxh3_128_hex(std::as_bytes(std::span(cloth.holes))) +
           xxh3_128_hex(std::as_bytes(std::span(cloth.cell_stiffness))) +
           xxh3_128_hex(std::as_bytes(std::span(cloth.cell_density))) +
           xxh3_128_hex(std::as_bytes(std::span(cloth.cell_tear))) +
           (has_skin(cloth) ? xxh3_128_hex(std::as_bytes(std::span(cloth.particle_friction))) +
                                  xxh3_128_hex(std::as_bytes(std::span(cloth.particle_thickness)))
                            : "");
}

std::string given_hash(const MeshShape& mesh) {
    return xxh3_128_hex(std::as_bytes(std::span(mesh.vertices()))) +
           xxh3_128_hex(std::as_bytes(std::span(mesh.triangles())));
}

LoadedScene loaded_scene(const SceneRequest& request, SceneResult result) {
    if (!result.scene) throw SceneFailure(std::move(result));
    LoadedScene loaded{std::move(*result.scene), result.text, {}, {}};
    for (const SceneError& warning : result.warnings) loaded.warnings.push_back(warning.text());
    std::vector<std::string> hashed{std::move(result.text)};
    hashed.insert(hashed.end(), request.overrides.begin(), request.overrides.end());
    if (!result.files.empty()) {
        for (const Cloth& cloth : loaded.description.cloths) hashed.push_back(given_hash(cloth));
        for (const Collider& collider : loaded.description.colliders)
            if (const Mesh* mesh = std::get_if<Mesh>(&collider.shape)) {
                hashed.push_back(given_hash(*mesh->shape));
                if (mesh->sequence) hashed.push_back(xxh3_128_hex(std::as_bytes(mesh->sequence->places())));
            }
    }
    loaded.hash = run_key(hashed);
    if (request.image_size) loaded.description.image.size = *request.image_size;
    if (request.samples) loaded.description.image.samples = *request.samples;
    return loaded;
}

}  // namespace

LoadedScene load(const SceneRequest& request) {
    // The file is read once: what is hashed is what is run, also when it changes meanwhile or is a pipe.
    return loaded_scene(request, read_scene(request.path, request.overrides));
}

LoadedScene load_text(const SceneRequest& request, std::string text) {
    SceneResult result = read_scene_text(text, request.path, request.overrides, scene_folder(request.path));
    result.text = std::move(text);
    return loaded_scene(request, std::move(result));
}

std::string key_of(const RunRequest& request, const LoadedScene& scene, const DeviceInfo& device) {
    std::vector<std::string> parts{program_version(), scene.hash, device.uuid_text(), device.driver,
                                   device.driver_version};
    for (const SpirvModule& module : spirv_modules()) parts.push_back(xxh3_128_hex(std::as_bytes(module.words)));
    const ImageSettings& image = scene.description.image;
    parts.push_back(request.draws() ? fmt::format("picture {}x{} {}", image.size[0], image.size[1], image.samples)
                                    : "arrays");
    const PictureView& view = request.scene.view;
    if (request.draws() && view.kind != View::shaded)
        parts.push_back(fmt::format("{} {}", spelling(view_spellings, view.kind), view.range));
    return run_key(parts);
}

SimulationOptions simulation_options(const SceneRequest& request, bool draw, bool positions, bool velocities) {
    SimulationOptions options;
    if (request.view.range > 0 && !request.view.shows_strain())
        throw UsageError("--view-range is for --view stretch, warp or weft");
    options.draw = draw;
    options.view = request.view;
    options.positions = positions;
    options.velocities = velocities;
    options.skip = request.skip;
    options.kernels = request.kernels;
    return options;
}

Device device_of(const SceneRequest& request, const SceneDescription& scene, bool draws) {
    return Device::for_scene(scene, draws, request.device, validation_if(request.validate));
}

const char* program_version() { return DRAPE_VERSION; }

bool RunRequest::draws() const {
    return std::ranges::any_of(output_formats(formats), [](const OutputFormat* format) { return format->draws; });
}

bool RunRequest::details() const {
    return std::ranges::any_of(output_formats(formats), [](const OutputFormat* format) { return format->details; });
}

SceneDescription asked_scene(const SceneRequest& request) { return load(request).description; }

std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format) {
    const SceneDescription scene = load(request).description;
    const Device device(request.device, validation_if(request.validate));  // there is one graph, on one device
    return Simulation(scene, simulation_options(request, draw, !draw, !draw), device).describe_plan(format);
}

}  // namespace drape
