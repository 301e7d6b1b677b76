// No substep can follow cloth that is held where colliders or its own rigid springs cannot let it be.
#pragma once

#include <cstdint>
#include <string>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns one sentence about the end of a frame: a particle held inside a collider, which pushes its neighbours out,
/// or two held particles of rigid cloth farther apart than they are at rest by more than the worst spring may be
/// stretched. Empty: nothing of the kind is known. A particle is inside when its centre is in the shape, or in a
/// tapered capsule's thin core.
std::string impossible_pins(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
