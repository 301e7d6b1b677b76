// Reads PLY, the Stanford polygon format.
#pragma once

#include <filesystem>

#include "input/mesh_data.h"

namespace drape::input {

/// Returns the element `vertex` by its x, y, z, and the lists `vertex_indices` (or `vertex_index`) of the elements
/// `face` and `tristrips`, of a file in ASCII or binary of either byte order; all else is passed over. What the header
/// counts is held against the bytes that are there before memory is taken. Source: Greg Turk, "The PLY Polygon File
/// Format", 1994. Throws OutputError naming the file, and the line or the byte.
MeshData read_ply(const std::filesystem::path& path);

}  // namespace drape::input
