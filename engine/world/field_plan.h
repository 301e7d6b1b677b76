// How finely the distances to a mesh are known.
#pragma once

#include <cstddef>

#include "drape/scene.h"

namespace drape {

struct FieldPlan {
    double wanted;       ///< m, between points: what the mesh asks for, else half of the least distance of particles
    double spacing;      ///< m: as the room for fields allows
    double margin;       ///< m: contact looks so far beyond the surface
    std::size_t points;  ///< of the field
    std::size_t texels;  ///< that a device has for it (shared/collider_types.h)
};

/// Returns that of a mesh that was read, among a scene's colliders. A spacing that the mesh asks for is kept, however
/// many points it takes; all fields have room for `most_field_points` (mesh/distance_field.h).
FieldPlan field_plan(const SceneDescription& scene, const Collider& mesh);

}  // namespace drape
