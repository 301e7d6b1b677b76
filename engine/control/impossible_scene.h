// Says why no number of substeps can follow a scene, where the scene alone shows it, so that a refusal can name a
// remedy.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "control/bounds.h"

namespace drape {

/// How many particles pins hold inside a collider.
struct HeldInside {
    std::size_t collider = 0;   ///< index in the scene
    std::size_t particles = 0;  ///< number of them
    double depth = 0;           ///< m below the surface, of the deepest particle
};
/// Returns the particles that pins hold inside the collider in which one is deepest at `time`. Distances are exact in
/// double precision.
std::optional<HeldInside> held_inside(const SimulationModel& model, std::size_t cloth, double time);

/// Returns the room (m) between two colliders' shapes at a time, 0 where they touch or overlap. It is found by
/// alternating projections (von Neumann 1933), whose distance converges to that of the closest points of convex shapes.
double room_between(const Collider& a, const Collider& b, double time);

// Rows of the table call these functions for a cloth at the end of a frame. They return nothing where the scene has no
// such problem.

/// The depth, m, of the particles that pins hold inside a collider, which pushes their neighbours out.
std::optional<Finding> held_in_collider(const SimulationModel& model, std::size_t cloth, std::uint32_t frame);
/// How much farther apart than at rest, relative to that distance, pins hold two particles of rigid cloth.
std::optional<Finding> held_apart(const SimulationModel& model, std::size_t cloth, std::uint32_t frame, double bound);
/// Two colliders that leave the cloth less room, m, than at the start and less than it needs.
std::optional<Finding> pinched(const SimulationModel& model, std::size_t cloth, std::uint32_t frame);
/// How many times over wind brings the cloth to its own speed within a frame.
std::optional<Finding> blown_away(const SimulationModel& model, std::size_t cloth, double bound);

/// Returns what the first of these rows that is beyond its bound at the end of a frame says, with its remedy, in one
/// sentence. Empty: nothing that is known makes the scene impossible.
std::string impossible_scene(const SimulationModel& model, std::uint32_t frame,
                             std::span<const SceneBound> rows = scene_bounds());

}  // namespace drape
