// The input is a scene file's text and, behind a zero byte each, overrides. The reader gives a scene or located errors,
// its resolved text says the same, and everything in a small scene is planned that needs no device.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "cloth/cloth_state.h"
#include "cloth/frame_inputs.h"
#include "control/watch.h"
#include "drape/scene_reader.h"
#include "fuzz.h"

namespace drape {
namespace {

using fuzz::require;

constexpr std::size_t most_errors = 101;  ///< a hundred, and one that tells how many more there are
constexpr std::uint64_t most_particles = 300;
constexpr std::uint32_t most_substeps = 64;

/// Cloths of millions of particles take their time and reach no code of their own, so they are left out.
bool has_large_grid(const std::string& input) {
    for (std::size_t at = input.find("grid"); at != std::string::npos; at = input.find("grid", at + 1)) {
        double particles = 1;
        const char* next = input.c_str() + at;
        for (int side = 0; side < 2; ++side) {
            next += std::strcspn(next, "0123456789");
            char* end = nullptr;
            const double value = std::strtod(next, &end);
            if (end == next) break;
            particles *= value;
            next = end;
        }
        if (!(particles <= 10'000)) return true;
    }
    return false;
}

void check_errors(const std::vector<SceneError>& errors, bool overridden) {
    require(errors.size() <= most_errors, "more errors than anybody reads");
    for (const SceneError& error : errors) {
        require(!error.message.empty(), "an error without a message");
        require(overridden || (error.line >= 1 && error.column >= 1), "an error without a place: " + error.text());
    }
}

/// The data with which each buffer and image of a cloth starts fits into it.
void plan_fields(const SimulationModel& model) {
    for (const ClothModel& cloth : model.cloths) {
        const CutTopology topology(cloth);
        const FieldContext about{model, cloth, topology, {.drawing = true, .statistics = true}};
        for (const FieldRow& row : cloth_fields()) {
            if (!row.needed(about)) continue;
            const FieldExtent extent = row.extent(about);
            require(extent.width > 0 && extent.height > 0, fmt::format("field '{}' has no size", row.name));
            if (row.start)
                require(row.start(about).size() <= extent.count() * row.element.size,
                        fmt::format("what field '{}' starts with is larger than it", row.name));
        }
    }
}

/// Default lights keep the published directions, lights that are read get unit ones; this makes them comparable.
SceneDescription with_unit_lights(SceneDescription scene) {
    for (DirectionalLight& light : scene.lights) {
        const Vec3 d = light.direction;
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (double& each : light.direction) each = std::round(each / length * 1e9);
    }
    return scene;
}

void plan(const SceneDescription& scene) {
    std::uint64_t particles = 0;
    for (const Cloth& cloth : scene.cloths) particles += std::uint64_t{cloth.grid[0]} * cloth.grid[1];
    require(particles <= scene_particle_limit, "more particles than the limit");
    if (particles > most_particles || scene.solver.iterations > most_substeps) return;
    if (scene.solver.method != SolverMethod::automatic && scene.solver.substeps > most_substeps) return;
    const SimulationModel model(scene);
    for (const Compromise& each : model.compromises()) require(!each.reason.empty(), "a compromise without a reason");
    for (const SkippedWork& each : model.skipped()) require(!each.reason.empty(), "a skip without a reason");
    plan_fields(model);
    const Watch watch(model);
    if (model.scene.solver.substeps > most_substeps || scene.time.frame_count < 2) return;
    const FrameInputs inputs = frame_inputs(model, 1);
    require(inputs.colliders.size() <= collider_record_count(model), "more colliders than there is room for");
}

}  // namespace
}  // namespace drape

extern "C" int DRAPE_FUZZ_ENTRY(scene_text)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    std::string_view rest = fuzz::text_of(data, size);
    if (has_large_grid(std::string(rest))) return 0;
    std::vector<std::string> overrides;
    const std::string_view text = rest.substr(0, rest.find('\0'));
    while (rest.find('\0') != std::string_view::npos) {
        rest.remove_prefix(rest.find('\0') + 1);
        overrides.emplace_back(rest.substr(0, rest.find('\0')));
    }
    const SceneResult result = read_scene_text(text, "fuzz", overrides);
    require(result.scene.has_value() == result.errors.empty(), "neither a scene nor errors, or both");
    check_errors(result.errors, !overrides.empty());
    check_errors(result.warnings, !overrides.empty());
    if (!result.scene) return 0;
    const std::string resolved = resolved_scene(text, overrides);
    if (std::getenv("DRAPE_FUZZ_PRINT")) fmt::print(stderr, "{}\n", resolved);
    const SceneResult again = read_scene_text(resolved, "resolved");
    require(again.scene && with_unit_lights(*again.scene) == with_unit_lights(*result.scene),
            "the resolved scene is another one");
    plan(*result.scene);
    return 0;
}
