// No substep can follow cloth that is held where colliders or its own rigid springs cannot let it be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cloth/simulation_model.h"

namespace drape {

/// Particles that pins hold inside a collider.
struct HeldInside {
    std::size_t collider = 0;   ///< index in the scene
    std::size_t particles = 0;  ///< number of them
    double depth = 0;           ///< m: the deepest one's, below the surface
};

/// Returns those in the collider that they are deepest in, at a time. Distances are exact in double precision.
std::optional<HeldInside> held_inside(const SimulationModel& model, std::size_t cloth, double time);

/// Returns one sentence about the end of a frame: a particle held inside a collider, which pushes its neighbours out,
/// or two held particles of rigid cloth farther apart than they are at rest by more than the worst spring may be
/// stretched. Empty: nothing of the kind is known.
std::string impossible_pins(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
