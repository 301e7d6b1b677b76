#include "mesh/sequence_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "base/vectors.h"
#include "input/file_source.h"
#include "input/obj_file.h"
#include "input/point_poses.h"
#include "mesh/mesh_error.h"

namespace drape {

namespace {

namespace fs = std::filesystem;

std::shared_ptr<const MeshSequence> read_both(const std::string& file, const std::string& poses, double scale,
                                              std::optional<double> shell, Solid solid) {
    if (input::extension_of(file) != ".obj")
        throw MeshError(fmt::format("expected an OBJ file, whose vertices have numbers, beside poses, got {}", file));
    input::MeshData mesh = input::read_obj(file);
    if (mesh.triangles.empty()) throw MeshError(fmt::format("expected triangles, {} has none", file));
    for (Vec3& at : mesh.vertices) {
        at = times(scale, at);
        for (const double x : at)
            if (!(std::abs(x) < 1e15)) throw MeshError(fmt::format("expected finite coordinates, {} has {}", file, x));
    }
    std::vector<std::uint32_t> places;
    const MeshShape form(mesh.vertices, std::move(mesh.triangles), shell, &places, solid);
    std::vector<float> xyz = input::read_poses(poses, mesh.vertices.size()).xyz;
    for (float& x : xyz) x = static_cast<float>(scale * x);
    return std::make_shared<const MeshSequence>(form, places, xyz);
}

/// Several files are read anew, since each of them may have changed; what they hold may be known.
std::shared_ptr<const MeshSequence> known_one(std::shared_ptr<const MeshSequence> made) {
    static std::vector<std::weak_ptr<const MeshSequence>> kept;
    std::erase_if(kept, [](const auto& each) { return each.expired(); });
    for (const auto& each : kept)
        if (std::shared_ptr<const MeshSequence> known = each.lock();
            known && known->form()->shell() == made->form()->shell() &&
            known->form()->triangles() == made->form()->triangles() &&
            std::ranges::equal(known->places(), made->places()))
            return known;
    kept.push_back(made);
    return made;
}

using Key = std::tuple<std::string, fs::file_time_type, std::string, fs::file_time_type, double, double, Solid>;

}  // namespace

std::shared_ptr<const MeshSequence> read_sequence(const std::string& file, const std::string& poses, double scale,
                                                  std::optional<double> shell, Solid solid) {
    static std::mutex mutex;
    static std::map<Key, std::weak_ptr<const MeshSequence>> kept;
    std::error_code code, no_one_file;
    const Key key{
        file, fs::last_write_time(file, code), poses, fs::last_write_time(poses, no_one_file), scale, shell.value_or(0),
        solid};
    const std::lock_guard lock(mutex);
    try {
        if (no_one_file) return known_one(read_both(file, poses, scale, shell, solid));
        std::erase_if(kept, [](const auto& each) { return each.second.expired(); });
        std::weak_ptr<const MeshSequence>& known = kept[key];
        std::shared_ptr<const MeshSequence> sequence = known.lock();
        if (!sequence) known = sequence = read_both(file, poses, scale, shell, solid);
        return sequence;
    } catch (const OutputError& error) {
        throw MeshError(error.what());
    }
}

}  // namespace drape
