// The wind acts on those quarters of cells that holes and cuts leave (docs/physics.md 6).
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/cut_topology.h"

namespace drape {

/// Returns the bits of a particle of masked cloth (shaders/shared/simulation_types.h): its quarters of cells, which a
/// cut leaves it, and the neighbours that springs still hold it to.
std::uint32_t air_of(const CutTopology& topology, int column, int row);
/// Returns those of all particles, row by row; nothing of cloth that is not masked.
std::vector<std::uint32_t> air_bits(const CutTopology& topology);

}  // namespace drape
