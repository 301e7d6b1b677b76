// A triangle mesh as a file has it, and what its readers share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace drape::input {

/// Vertices in the file's unit, and each triangle's three numbers of those.
struct MeshData {
    std::vector<std::array<double, 3>> vertices = {};
    std::vector<std::array<std::uint32_t, 3>> triangles = {};
};

inline constexpr std::size_t mesh_file_byte_limit = std::size_t{256} << 20;
inline constexpr std::size_t mesh_triangle_limit = 4'000'000;
inline constexpr std::size_t mesh_vertex_limit = 16'000'000;

/// Throws OutputError naming the file where the mesh has more vertices or triangles than are taken.
void expect_limits(const MeshData& mesh, const std::string& file);

/// Adds a face as a fan of triangles from its first corner, as OpenGL draws it; one of fewer than three corners is
/// none.
void add_face(MeshData& mesh, std::span<const std::uint32_t> corners);
/// Adds a strip of triangles, every other of which is turned over.
void add_strip(MeshData& mesh, std::span<const std::uint32_t> corners);

}  // namespace drape::input
