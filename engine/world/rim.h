// Finds the particles along the rims of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace drape {

/// Returns the particles along each rim, in the order in which the cloth is on one side, row by row by their first
/// ones. `missing`: by cell, row by row. No two cells may meet in a particle alone.
std::vector<std::vector<std::uint32_t>> rims_of(const std::array<std::uint32_t, 2>& grid,
                                                const std::vector<bool>& missing);

}  // namespace drape
