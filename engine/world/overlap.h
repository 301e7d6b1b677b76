// Finds cloth that starts inside a collider.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

struct StartOverlap {
    std::size_t cloth = 0, collider = 0;  ///< indices of the scene's lists
    double depth = 0;                     ///< m: the deepest particle's, below the surface
    std::size_t particles = 0;            ///< number of them inside
    std::size_t others = 0;               ///< number of further colliders that the cloth starts inside of
};

/// Returns the collider that a cloth is deepest in, for every cloth with particles inside a collider at time 0 by more
/// than a thousandth of its shorter edge. The thickness does not count, because cloth may be laid on what it rests on.
/// Distances are exact in double precision (world/surface_distance.h). Cloths beyond 2^18 particles are sampled.
std::vector<StartOverlap> start_overlaps(const SceneDescription& scene);

/// The face by which a cloth leaves a box that it starts in.
struct WayOut {
    Vec3 normal{0, 0, 0};  ///< outward, in the box's frame; 0: particles leave by the nearest face
    double until = 0;      ///< s: everything is out by then, unless something holds it
    bool operator==(const WayOut&) const = default;
};

/// Returns the way out of each collider. All of a cloth leaves a box by one face, at `speed` (m/s), because parts that
/// left by different ones would pull at each other and snap. It is the face that the particle farthest from it has the
/// shortest way to; a way along the cloth, which would press it together, counts up to three times.
std::vector<WayOut> ways_out(const Cloth& cloth, const std::vector<Collider>& colliders, double speed);

/// Returns where the scene has a collider, as in `/colliders/spheres/0`; `index` counts them sorted by kind.
std::string collider_place(const SceneDescription& scene, std::size_t index);

/// Returns a text like `starts up to 0.12 m inside /colliders/spheres/0 (37 of its particles)`.
std::string overlap_text(const SceneDescription& scene, const StartOverlap& overlap);

}  // namespace drape
