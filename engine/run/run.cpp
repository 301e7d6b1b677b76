#include "run/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/mesh_sequence.h"
#include "output/kept_frames.h"
#include "run/frame_sink.h"
#include "spirv_modules.h"
#include "world/cloth_keys.h"
#include "world/contact_shape.h"

namespace drape {

namespace {

template <class Values>
std::string hash_of(const Values& values) {
    return xxh3_128_hex(std::as_bytes(std::span(values)));
}

/// Returns the hash of what a key of the cloth takes from a file, whatever the file's name.
std::string given_hash(ClothKey key, const Cloth& cloth) {
    switch (key) {
        case ClothKey::start:
            return hash_of(cloth.start);
        case ClothKey::panel:
            return cloth.panel.empty() ? "" : hash_of(cloth.panel);
        case ClothKey::velocities:
            return cloth.velocities.empty() ? "" : hash_of(cloth.velocities);
        case ClothKey::holes:
            return hash_of(cloth.holes);
        case ClothKey::cell_stiffness:
            return hash_of(cloth.cell_stiffness);
        case ClothKey::cell_density:
            return hash_of(cloth.cell_density);
        case ClothKey::cell_tear:
            return hash_of(cloth.cell_tear);
        case ClothKey::loads: {
            std::string hash;
            for (const Load& load : cloth.loads) hash += load.factors.empty() ? "" : hash_of(load.factors);
            return hash;
        }
        case ClothKey::particle_friction:
            return has_skin(cloth) ? hash_of(cloth.particle_friction) : "";
        case ClothKey::particle_thickness:
            return has_skin(cloth) ? hash_of(cloth.particle_thickness) : "";
        case ClothKey::appearance:
            return cloth.appearance.image ? hash_of(cloth.appearance.image->rgb) : "";
        // The scene's text contains these values.
        case ClothKey::name:
        case ClothKey::grid:
        case ClothKey::size:
        case ClothKey::placement:
        case ClothKey::rest:
        case ClothKey::areal_density:
        case ClothKey::stiffness:
        case ClothKey::stiffness_keys:
        case ClothKey::damping:
        case ClothKey::friction:
        case ClothKey::thickness:
        case ClothKey::contact:
        case ClothKey::self_collision:
        case ClothKey::velocity:
        case ClothKey::tear:
        case ClothKey::pins:
            return "";
    }
    return "";
}

std::string given_hash(const Cloth& cloth) {
    std::string hash;
    for (const ClothKey key : cloth_keys) hash += given_hash(key, cloth);
    return hash;
}

std::string given_hash(const MeshShape& mesh) { return hash_of(mesh.vertices()) + hash_of(mesh.triangles()); }

LoadedScene loaded_scene(const SceneRequest& request, SceneResult result) {
    if (!result.scene) throw SceneFailure(std::move(result));
    LoadedScene loaded{std::move(*result.scene), result.text, {}, {}};
    for (const SceneError& warning : result.warnings) loaded.warnings.push_back(warning.text());
    std::vector<std::string> hashed{std::move(result.text)};
    hashed.insert(hashed.end(), request.overrides.begin(), request.overrides.end());
    if (!result.files.empty()) {
        for (const Cloth& cloth : loaded.description.cloths) hashed.push_back(given_hash(cloth));
        for (const Collider& collider : loaded.description.colliders)
            if (const Mesh* mesh = special(collider.shape).mesh) {
                hashed.push_back(given_hash(*mesh->shape));
                if (mesh->sequence) hashed.push_back(hash_of(mesh->sequence->places()));
            }
    }
    loaded.hash = run_key(hashed);
    ImageSettings& image = loaded.description.image;
    if (request.draft) {
        for (std::uint32_t& side : image.size) side = std::max(1u, side / 2);
        image.samples = image.motion_blur = 1;
    }
    if (request.image_size) image.size = *request.image_size;
    if (request.samples) image.samples = *request.samples;
    if (request.motion_blur) image.motion_blur = *request.motion_blur;
    return loaded;
}

}  // namespace

LoadedScene load(const SceneRequest& request) {
    // The file is read once, so that the hashed text is the one that is simulated, even if the file changes meanwhile
    // or is a pipe.
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
    if (request.draws() && image.motion_blur > 1) parts.push_back(fmt::format("blur {}", image.motion_blur));
    if (request.layers()) parts.push_back(fmt::format("layers {}x{}", image.size[0], image.size[1]));
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

bool RunRequest::layers() const {
    return std::ranges::any_of(output_formats(formats), [](const OutputFormat* format) { return format->layers; });
}

bool RunRequest::details() const {
    return std::ranges::any_of(output_formats(formats), [](const OutputFormat* format) { return format->details; });
}

SceneDescription asked_scene(const SceneRequest& request) { return load(request).description; }

std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format) {
    const SceneDescription scene = load(request).description;
    const Device device(request.device, validation_if(request.validate));  // the graph is a single one, on one device
    return Simulation(scene, simulation_options(request, draw, !draw, !draw), device).describe_plan(format);
}

}  // namespace drape
