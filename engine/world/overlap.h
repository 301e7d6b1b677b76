// Finds cloth that starts inside a collider.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

struct StartOverlap {
    std::size_t cloth = 0, collider = 0;  ///< indices of the scene's lists
    double depth = 0;                     ///< m, of the deepest particle below the surface
    std::size_t particles = 0;            ///< number of them inside
    std::size_t others = 0;               ///< number of further colliders inside which the cloth starts
};

/// Returns, for every cloth with particles inside a collider at time 0, the collider in which it is deepest, if by more
/// than a thousandth of its shorter edge. The thickness does not count, because cloth may be laid on what it rests on.
/// Distances are exact in double precision (world/surface_distance.h). Cloths of more than 2^18 particles are sampled.
std::vector<StartOverlap> start_overlaps(const SceneDescription& scene);

/// The face through which a cloth leaves a box in which it starts.
struct WayOut {
    Vec3 normal{0, 0, 0};  ///< outward, in the box's frame; 0: particles leave through the nearest face
    double until = 0;      ///< s: all particles are out by then, unless something holds them
    bool operator==(const WayOut&) const = default;
};

/// Returns the way out of each collider. All of a cloth leaves a box through one face, at `speed` (m/s), because parts
/// that left through different faces would pull at each other and snap. It is the face with the shortest way for the
/// particle that is farthest from it; a way along the cloth, which would press it together, counts up to three times.
std::vector<WayOut> ways_out(const Cloth& cloth, const std::vector<Collider>& colliders, double speed);

/// Returns the place of a collider in the scene, as in `/colliders/spheres/0`; `index` counts colliders sorted by kind.
std::string collider_place(const SceneDescription& scene, std::size_t index);

/// Returns a text like `starts up to 0.12 m inside /colliders/spheres/0 (37 of its particles)`.
std::string overlap_text(const SceneDescription& scene, const StartOverlap& overlap);

}  // namespace drape
