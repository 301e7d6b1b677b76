#include "mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <mutex>
#include <string_view>
#include <tuple>

#include "base/output_error.h"
#include "input/file_source.h"
#include "input/gltf_file.h"
#include "input/obj_file.h"
#include "input/ply_file.h"
#include "input/stl_file.h"
#include "mesh/mesh_error.h"

namespace drape {

namespace {

namespace fs = std::filesystem;

using Read = input::MeshData(const fs::path& path);
constexpr std::pair<std::string_view, Read*> readers[] = {
    {".obj", input::read_obj},   {".ply", input::read_ply},  {".stl", input::read_stl},
    {".gltf", input::read_gltf}, {".glb", input::read_gltf},
};

/// Returns the reader of a file that is there and not too large.
Read* reader_of(const fs::path& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (code || !fs::exists(status))
        throw MeshError(fmt::format("cannot read {}: {}", path.string(), code ? code.message() : "no such file"));
    if (!fs::is_regular_file(status)) throw MeshError(fmt::format("cannot read {}: it is not a file", path.string()));
    const std::string end = input::extension_of(path);
    const auto found = std::ranges::find(readers, end, &std::pair<std::string_view, Read*>::first);
    if (found == std::end(readers))
        throw MeshError(
            fmt::format("expected a file whose name ends in .obj, .ply, .stl, .gltf or .glb, got {}", path.string()));
    if (const auto size = fs::file_size(path, code); code || size > input::mesh_file_byte_limit)
        throw MeshError(fmt::format("expected a mesh file of at most {} bytes, got {} of {}",
                                    input::mesh_file_byte_limit, path.string(), size));
    return found->second;
}

/// Returns the vertices that triangles have, in metres, and numbers the triangles' corners by them.
std::vector<Vec3> used_vertices(input::MeshData& mesh, const std::string& path, double scale) {
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(mesh.vertices.size(), unused);
    std::vector<Vec3> vertices;
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle) {
            std::uint32_t& place = places[corner];
            if (place == unused) {
                place = static_cast<std::uint32_t>(vertices.size());
                Vec3& vertex = vertices.emplace_back();
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double entry = mesh.vertices[corner][axis];
                    vertex[axis] = scale * entry;
                    if (!(std::abs(vertex[axis]) < 1e15))
                        throw MeshError(
                            fmt::format("expected finite coordinates, vertex {} of {} has {}", corner, path, entry));
                }
            }
            corner = place;
        }
    return vertices;
}

std::shared_ptr<const MeshShape> read(Read* read_file, const std::string& path, double scale,
                                      std::optional<double> shell, Solid solid) try {
    input::MeshData mesh = read_file(path);
    if (mesh.triangles.empty()) throw MeshError(fmt::format("expected triangles, {} has none", path));
    const std::vector<Vec3> vertices = used_vertices(mesh, path, scale);
    return std::make_shared<const MeshShape>(vertices, std::move(mesh.triangles), shell, nullptr, solid);
} catch (const OutputError& error) {
    throw MeshError(error.what());
}

}  // namespace

std::shared_ptr<const MeshShape> read_mesh(const std::string& path, double scale, std::optional<double> shell,
                                           Solid solid) {
    Read* const read_file = reader_of(path);
    using Key = std::tuple<std::string, fs::file_time_type, std::uintmax_t, double, double, Solid>;
    static std::mutex mutex;
    static std::map<Key, std::weak_ptr<const MeshShape>> kept;
    const Key key{path, fs::last_write_time(path), fs::file_size(path), scale, shell.value_or(0), solid};
    const std::lock_guard lock(mutex);
    std::erase_if(kept, [](const auto& each) { return each.second.expired(); });
    std::weak_ptr<const MeshShape>& known = kept[key];
    std::shared_ptr<const MeshShape> mesh = known.lock();
    if (!mesh) known = mesh = read(read_file, path, scale, shell, solid);
    return mesh;
}

}  // namespace drape
