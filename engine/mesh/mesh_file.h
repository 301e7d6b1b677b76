// Reads meshes from files.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/mesh_shape.h"

namespace drape {

inline constexpr std::size_t mesh_file_byte_limit = std::size_t{256} << 20;
inline constexpr std::size_t mesh_triangle_limit = 4'000'000;
/// The endings of files that can be read.
inline constexpr std::string_view mesh_file_ends[] = {".obj", ".ply", ".stl", ".gltf", ".glb"};

/// Returns the mesh of a file, its coordinates times `scale` in metres; faces with more corners are cut into fans of
/// triangles, points and lines are left out. The same one, asked for again while it is in use and the file is as it
/// was, is not read again. Throws MeshError.
std::shared_ptr<const MeshShape> read_mesh(const std::string& path, double scale, std::optional<double> shell);

}  // namespace drape
