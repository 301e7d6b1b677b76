// Reads STL.
#pragma once

#include <filesystem>

#include "input/mesh_data.h"

namespace drape::input {

/// Returns the triangles of a binary or an ASCII file; normals, names and attributes are left out. A file as long as a
/// binary one with its number of triangles is one, also where it begins with "solid". Throws OutputError naming the
/// file, and the line.
MeshData read_stl(const std::filesystem::path& path);

}  // namespace drape::input
