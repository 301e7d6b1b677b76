// Reads meshes from files.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mesh/mesh_shape.h"

namespace drape {

/// Returns the mesh of a file, its coordinates times `scale` in metres; faces with more corners are cut into fans of
/// triangles, points and lines are left out. The same one, asked for again while it is in use and the file is as it
/// was, is not read again. Throws MeshError.
std::shared_ptr<const MeshShape> read_mesh(const std::string& path, double scale, std::optional<double> shell,
                                           Solid solid = Solid::mended);

}  // namespace drape
