#include "sweep/dataset.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <optional>
#include <regex>

#include "base/output_error.h"
#include "output/atomic_file.h"
#include "output/json_text.h"
#include "run/given_values.h"
#include "run/run.h"
#include "run/written_colliders.h"

namespace drape::sweep {

namespace fs = std::filesystem;

namespace {

/// The shapes of a trajectory follow from these; -1: not the same in all runs.
struct Shape {
    std::int64_t frames = 0, nodes = 0, cells = 0;
    double dt = 0;
};

std::optional<Shape> shape_of(const SweepSpec& spec, std::uint32_t index) {
    const SceneResult result = read_scene(spec.scene, spec.overrides_of(index));
    if (!result.scene) return std::nullopt;
    Shape shape{result.scene->time.frame_count, 0, 0, 1 / result.scene->time.fps};
    for (const Cloth& cloth : result.scene->cloths) {
        shape.nodes += std::int64_t{cloth.grid[0]} * cloth.grid[1];
        shape.cells +=
            cloth.holes.empty() ? 2 * (std::int64_t{cloth.grid[0]} - 1) * (cloth.grid[1] - 1) : -1'000'000'000;
    }
    for (const WrittenCollider& obstacle : written_obstacles(*result.scene)) {
        shape.nodes += static_cast<std::int64_t>(obstacle.vertices.size());
        shape.cells += static_cast<std::int64_t>(obstacle.faces.size() / 3);
    }
    return shape;
}

/// Returns whether the value at this place of a scene may decide the shapes of a trajectory. Runs that differ only in
/// other values have equal shapes.
bool shapes(const std::string& pointer) {
    static const std::regex pointers(
        "/(time|time/(fps|frames)|cloths|cloths/[^/]*|cloths/[^/]*/(grid|holes)(/.*)?|"
        "colliders(/[^/]*(/[^/]*)?)?|colliders/meshes/.*)");
    return std::regex_match(pointer, pointers);
}

Shape common_shape(const SweepSpec& spec) {
    std::optional<Shape> common;
    const bool differ = std::ranges::any_of(spec.parameters, [](const auto& entry) { return shapes(entry.first); });
    for (std::uint32_t index = 0; index < spec.count && (differ || !common); ++index) {
        const auto shape = shape_of(spec, index);
        if (!shape) continue;
        if (!common) common = shape;
        if (shape->frames != common->frames) common->frames = -1;
        if (shape->nodes != common->nodes) common->nodes = -1;
        if (shape->cells != common->cells) common->cells = -1;
        if (shape->dt != common->dt) common->dt = -1;
    }
    if (common && common->cells < 0) common->cells = -1;  // only the run itself knows its holes
    return common.value_or(Shape{-1, -1, -1, -1});
}

Json::Value feature(const char* type, const std::vector<std::int64_t>& shape, const char* dtype) {
    Json::Value value(Json::objectValue);
    value["type"] = type;
    value["dtype"] = dtype;
    for (const std::int64_t length : shape) value["shape"].append(Json::Int64{length});
    return value;
}

/// Returns the arrays of what was put into the trajectories: of the first run that there is.
Json::Value inputs(const SweepSpec& spec, std::int64_t frames) {
    Json::Value all(Json::objectValue);
    for (std::uint32_t index = 0; index < spec.count; ++index) {
        const SceneResult result = read_scene(spec.scene, spec.overrides_of(index));
        if (!result.scene) continue;
        for (const auto& [name, value] : given_values(*result.scene, 0))
            all[name] = feature("dynamic", {frames}, "float64");
        for (const auto& [name, array] : set_arrays(spec.overrides_of(index))) {
            all[name] = Json::Value(Json::objectValue);
            all[name]["type"] = "static";
        }
        break;
    }
    return all;
}

}  // namespace

void give_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::remove(to, error);
    fs::create_hard_link(from, to, error);
    if (error) fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    if (error) throw OutputError(fmt::format("cannot write '{}': {}", to.string(), error.message()));
}

void write_meta(const fs::path& folder, const SweepSpec& spec) {
    const Shape shape = common_shape(spec);
    Json::Value meta(Json::objectValue);
    meta["simulator"] = fmt::format("drape {}", program_version());
    meta["trajectory_length"] = Json::Int64{shape.frames};
    meta["dt"] = shape.dt;
    Json::Value& features = meta["features"];
    features["cells"] = feature("static", {1, shape.cells, 3}, "int32");
    features["mesh_pos"] = feature("static", {1, shape.nodes, 2}, "float32");
    features["node_type"] = feature("static", {1, shape.nodes, 1}, "int32");
    features["world_pos"] = feature("dynamic", {shape.frames, shape.nodes, 3}, "float32");
    for (const std::string& name : features.getMemberNames()) meta["field_names"].append(name);
    meta["inputs"] = inputs(spec, shape.frames);
    for (std::uint32_t index = 0; index < spec.count && spec.split; ++index)
        meta["split"][std::string(spec.part_of(index))].append(index);
    write_file(folder / "meta.json", json_text(meta));
}

}  // namespace drape::sweep
