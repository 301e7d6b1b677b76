// Says why no substep can follow a scene, where that can be known from the scene: for a refusal, so that it names what
// can be done.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "control/bounds.h"

namespace drape {

/// Particles that pins hold inside a collider.
struct HeldInside {
    std::size_t collider = 0;   ///< index in the scene
    std::size_t particles = 0;  ///< number of them
    double depth = 0;           ///< m: the deepest one's, below the surface
};
/// Returns those in the collider that they are deepest in, at a time. Distances are exact in double precision.
std::optional<HeldInside> held_inside(const SimulationModel& model, std::size_t cloth, double time);

/// Returns the room (m) between two colliders' shapes at a time, 0 where they touch or overlap; by alternating
/// projections (von Neumann 1933), whose distance falls to that of the two closest points of convex shapes.
double room_between(const Collider& a, const Collider& b, double time);

// Rows of the table ask these of a cloth at the end of a frame. Nothing: there is nothing of the kind.

/// The depth, m, of the particles that pins hold inside a collider, which pushes their neighbours out.
std::optional<Finding> held_in_collider(const SimulationModel& model, std::size_t cloth, std::uint32_t frame);
/// By how much farther apart than at rest pins hold two particles of rigid cloth.
std::optional<Finding> held_apart(const SimulationModel& model, std::size_t cloth, std::uint32_t frame, double bound);
/// Two colliders that leave the cloth less room than at the start, and less than it takes, m.
std::optional<Finding> pinched(const SimulationModel& model, std::size_t cloth, std::uint32_t frame);
/// How often wind takes the cloth to its own speed in the time of a frame.
std::optional<Finding> blown_away(const SimulationModel& model, std::size_t cloth, double bound);

/// Returns what the first of these rows that is beyond its bound says of the end of a frame: in one sentence, and what
/// to do. Empty: nothing is known that makes the scene impossible.
std::string impossible_scene(const SimulationModel& model, std::uint32_t frame,
                             std::span<const SceneBound> rows = scene_bounds());

}  // namespace drape
