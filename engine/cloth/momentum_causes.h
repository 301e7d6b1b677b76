// This names what may change a cloth's momentum, and its angular momentum about the point that its statistics take.
#pragma once

#include "cloth/simulation_model.h"
#include "drape/momenta.h"

namespace drape {

Momenta momentum_causes(const SimulationModel& model, std::size_t cloth);

}  // namespace drape
