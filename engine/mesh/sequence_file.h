// Reads meshes that deform.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mesh/mesh_sequence.h"

namespace drape {

/// Returns the mesh of an OBJ file with its vertices' poses (input/point_poses.h), all coordinates times `scale` in
/// metres. The same one, asked for again while it is in use and the files are as they were, is not read again. Throws
/// MeshError.
std::shared_ptr<const MeshSequence> read_sequence(const std::string& file, const std::string& poses, double scale,
                                                  std::optional<double> shell, Solid solid = Solid::mended);

}  // namespace drape
