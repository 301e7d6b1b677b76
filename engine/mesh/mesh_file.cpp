#include "mesh/mesh_file.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "base/output_error.h"
#include "input/file_source.h"
#include "input/text_lines.h"
#include "mesh/mesh_error.h"

namespace Assimp {

/// Debian's build of the library calls this function when an assumption fails, and would then stop the program. Thrown
/// as an exception, it is an error of the file like others.
void aiAssertViolation(const char* failed, const char*, int) {
    throw std::runtime_error(fmt::format("the file breaks a rule ({})", failed));
}

}  // namespace Assimp

namespace drape {

namespace {

namespace fs = std::filesystem;

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Refuses files that the library should not see.
void look_at(const fs::path& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (code || !fs::exists(status))
        throw MeshError(fmt::format("cannot read {}: {}", path.string(), code ? code.message() : "no such file"));
    if (!fs::is_regular_file(status)) throw MeshError(fmt::format("cannot read {}: it is not a file", path.string()));
    const std::string end = lower_case(path.extension().string());
    if (std::ranges::find(mesh_file_ends, end) == std::end(mesh_file_ends))
        throw MeshError(
            fmt::format("expected a file whose name ends in .obj, .ply, .stl, .gltf or .glb, got {}", path.string()));
    if (const auto size = fs::file_size(path, code); code || size > mesh_file_byte_limit)
        throw MeshError(fmt::format("expected a mesh file of at most {} bytes, got {} of {}", mesh_file_byte_limit,
                                    path.string(), size));
}

/// Returns an OBJ file as the library reads it: it takes ".6" and a comment behind a face for errors of other kinds,
/// and words that are no numbers for numbers.
std::string obj_text(const fs::path& path) try {
    input::FileSource file(path);
    input::Lines lines(file);
    std::string text;
    for (std::string_view line; lines.next(line);) {
        line = line.substr(0, line.find('#'));
        std::array<double, 3> vertex{};
        const bool is_vertex = line.starts_with("v ") || line.starts_with("v\t");
        if (is_vertex && !input::read_vertex(line.substr(1), vertex))
            throw MeshError(fmt::format("line {} of {}: expected three numbers", lines.number(), path.string()));
        text += is_vertex ? fmt::format("v {} {} {}", vertex[0], vertex[1], vertex[2]) : line;
        text += '\n';
    }
    return text;
} catch (const OutputError& error) {
    throw MeshError(error.what());
}

/// Triangles of a file as they are gathered, node by node.
struct Gathered {
    const std::string& path;
    double scale;
    std::vector<Vec3> vertices = {};
    std::vector<Triangle> triangles = {};

    void add(const aiMesh& mesh, const aiMatrix4x4& placed) {
        const auto before = static_cast<std::uint32_t>(vertices.size());
        for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
            const aiVector3D v = placed * mesh.mVertices[k];
            vertices.push_back({scale * double{v.x}, scale * double{v.y}, scale * double{v.z}});
            for (const double entry : vertices.back())
                if (!(std::abs(entry) < 1e15))
                    throw MeshError(fmt::format("expected finite coordinates, vertex {} of {} has {}", k, path, entry));
        }
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) add(mesh.mFaces[k], before);
    }

    /// A face of more corners is cut into a fan from its first one, as OpenGL draws it.
    void add(const aiFace& face, std::uint32_t before) {
        for (unsigned k = 0; k < face.mNumIndices; ++k)
            if (face.mIndices[k] >= vertices.size() - before)
                throw MeshError(fmt::format("a face of {} has a corner that is not there", path));
        for (unsigned k = 2; k < face.mNumIndices; ++k)
            triangles.push_back({before + face.mIndices[0], before + face.mIndices[k - 1], before + face.mIndices[k]});
        if (triangles.size() > mesh_triangle_limit)
            throw MeshError(fmt::format("expected at most {} triangles, {} has more", mesh_triangle_limit, path));
    }

    void add(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above) {
        const aiMatrix4x4 placed = above * node.mTransformation;
        for (unsigned k = 0; k < node.mNumMeshes; ++k)
            if (node.mMeshes[k] < scene.mNumMeshes) add(*scene.mMeshes[node.mMeshes[k]], placed);
        for (unsigned k = 0; k < node.mNumChildren; ++k) add(scene, *node.mChildren[k], placed);
    }
};

std::shared_ptr<const MeshShape> read(const std::string& path, double scale, std::optional<double> shell) {
    Assimp::Importer importer;
    // No further processing: that of the library stops the program at faces that it does not expect.
    const bool is_obj = lower_case(fs::path(path).extension().string()) == ".obj";
    const std::string text = is_obj ? obj_text(path) : std::string();
    const aiScene* const scene =
        is_obj ? importer.ReadFileFromMemory(text.data(), text.size(), 0, "obj") : importer.ReadFile(path, 0);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw MeshError(fmt::format("{} is no mesh: {}", path, importer.GetErrorString()));
    Gathered gathered{path, scale};
    gathered.add(*scene, *scene->mRootNode, aiMatrix4x4());
    if (gathered.triangles.empty()) throw MeshError(fmt::format("expected triangles, {} has none", path));
    return std::make_shared<const MeshShape>(gathered.vertices, std::move(gathered.triangles), shell);
}

}  // namespace

std::shared_ptr<const MeshShape> read_mesh(const std::string& path, double scale, std::optional<double> shell) {
    look_at(path);
    using Key = std::tuple<std::string, fs::file_time_type, std::uintmax_t, double, double>;
    static std::mutex mutex;
    static std::map<Key, std::weak_ptr<const MeshShape>> kept;
    const Key key{path, fs::last_write_time(path), fs::file_size(path), scale, shell.value_or(0)};
    const std::lock_guard lock(mutex);
    std::erase_if(kept, [](const auto& each) { return each.second.expired(); });
    std::weak_ptr<const MeshShape>& known = kept[key];
    std::shared_ptr<const MeshShape> mesh = known.lock();
    if (!mesh) known = mesh = read(path, scale, shell);
    return mesh;
}

}  // namespace drape
