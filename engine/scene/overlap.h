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

/// The face by which a cloth leaves a box that it starts in.
struct WayOut {
    Vec3 normal{0, 0, 0};  ///< outward, in the box's frame; 0: what is inside leaves by its nearest face
    double until = 0;      ///< s: all is out by then, unless something holds it
    bool operator==(const WayOut&) const = default;
};

/// By collider. All of a cloth leaves a box by one face, at `speed` (m/s): parts that left by different ones would pull
/// at each other and snap. It is the face that the particle farthest from it has the shortest way to; a way along the
/// cloth, which would press it together, counts up to three times.
std::vector<WayOut> ways_out(const Cloth& cloth, const std::vector<Collider>& colliders, double speed);

/// `starts up to 0.12 m inside /colliders/spheres/0 (37 of its particles)`.
std::string overlap_text(const SceneDescription& scene, const StartOverlap& overlap);

}  // namespace drape
