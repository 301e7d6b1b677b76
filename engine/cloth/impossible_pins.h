// What no substep can follow: cloth that is held where colliders or its own rigid springs cannot let it be. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "cloth/simulation_model.h"

namespace drape {

/// One sentence about the end of a frame: a particle held inside a collider, which pushes its neighbours out, or two
/// held particles of rigid cloth farther apart than they are at rest by more than the worst spring may be stretched.
/// Empty: nothing of the kind is known. Deep is a particle's centre inside the shape; of a tapered capsule, inside its
/// thin core.
std::string impossible_pins(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
