// Says why no substep can follow a scene, where that can be known from the scene: for a refusal, so that it names what
// can be done.
#pragma once

#include <cstdint>
#include <string>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns the room (m) between two colliders' shapes at a time, 0 where they touch or overlap; by alternating
/// projections (von Neumann 1933), whose distance falls to that of the two closest points of convex shapes.
double room_between(const Collider& a, const Collider& b, double time);

/// Returns one sentence about the end of a frame: what impossible_pins says (impossible_pins.h); colliders that have
/// come so near to each other that a cloth finds no room between them; wind that takes a cloth along within a small
/// part of a frame. Empty: nothing of the kind is known.
std::string impossible_scene(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
