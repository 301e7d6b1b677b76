// The resolution of the field of distances to a mesh.
#pragma once

#include <cstddef>

#include "drape/scene.h"

namespace drape {

struct FieldPlan {
    double wanted;  ///< m, between points: what the mesh asks for, or else half of the least distance between particles
    double spacing;      ///< m: what the room for fields allows
    double margin;       ///< m: contact needs distances this far beyond the surface
    std::size_t points;  ///< of the field
    std::size_t texels;  ///< number of texels on the device (shared/collider_types.h)
};

/// Returns the plan for a mesh that was read, among a scene's colliders. A spacing that the mesh asks for is kept,
/// however many points it takes; all other fields share room for `most_field_points` (mesh/distance_field.h).
FieldPlan field_plan(const SceneDescription& scene, const Collider& mesh);

}  // namespace drape
