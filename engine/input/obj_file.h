// Reads Wavefront OBJ.
#pragma once

#include <filesystem>

#include "input/mesh_data.h"

namespace drape::input {

/// Returns the vertices (`v`) of an OBJ file in their order, and its faces. Points, lines and all else are left out.
/// Throws OutputError naming the file and the line.
MeshData read_obj(const std::filesystem::path& path);
/// A mesh, and the same triangles where a texture has them.
struct UvMesh {
    MeshData shape;
    MeshData chart;  ///< x and y are those of the texture
};
/// Returns the same with the texture's vertices (`vt`). Throws also where a corner of a face has none.
UvMesh read_obj_with_uv(const std::filesystem::path& path);
/// Returns the vertices alone; the faces are not looked at.
std::vector<std::array<double, 3>> read_obj_vertices(const std::filesystem::path& path);

}  // namespace drape::input
