#include "input/mesh_data.h"

#include <fmt/format.h>

#include "input/file_source.h"

namespace drape::input {

void expect_limits(const MeshData& mesh, const std::string& file) {
    if (mesh.triangles.size() > mesh_triangle_limit)
        throw unreadable(file, fmt::format("expected at most {} triangles, it has more", mesh_triangle_limit));
    if (mesh.vertices.size() > mesh_vertex_limit)
        throw unreadable(file, fmt::format("expected at most {} vertices, it has more", mesh_vertex_limit));
}

void add_face(MeshData& mesh, std::span<const std::uint32_t> corners) {
    for (std::size_t k = 2; k < corners.size(); ++k) mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

void add_strip(MeshData& mesh, std::span<const std::uint32_t> corners) {
    for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[k - 2 + k % 2], corners[k - 1 - k % 2], corners[k]});
}

}  // namespace drape::input
