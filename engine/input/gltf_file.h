// Reads glTF 2.
#pragma once

#include <filesystem>

#include "input/mesh_data.h"

namespace drape::input {

/// Returns the triangles, strips and fans that the nodes of a file's scene place, .gltf or .glb; points, lines, skins,
/// targets and looks are left out. Sparse accessors and extensions that change shapes are refused. Throws OutputError
/// naming the file and the place in its JSON.
MeshData read_gltf(const std::filesystem::path& path);

}  // namespace drape::input
