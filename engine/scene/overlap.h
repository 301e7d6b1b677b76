// Cloth that starts inside a collider.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

struct StartOverlap {
    std::size_t cloth = 0, collider = 0;  ///< indices of the scene's lists
    double depth = 0;                     ///< m, of the deepest particle's place below the surface
    std::size_t particles = 0;            ///< how many are inside
    std::size_t others = 0;               ///< more colliders that the cloth starts inside of
};

/// Of every cloth that has particles inside a collider at time 0 by more than a thousandth of its shorter edge: the
/// collider that it is deepest in. The thickness does not count: cloth may be laid on what it rests on. Distances are
/// exact in double precision (scene/surface_distance.h). Of cloths beyond 2^18 particles only every k-th is looked at.
std::vector<StartOverlap> start_overlaps(const SceneDescription& scene);

/// `starts up to 0.12 m inside /colliders/spheres/0 (37 of its particles)`.
std::string overlap_text(const SceneDescription& scene, const StartOverlap& overlap);

}  // namespace drape
