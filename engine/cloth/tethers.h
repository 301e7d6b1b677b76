// Tethers (long-range attachments) tell which held particles a free one hangs on, and how far it may be from them.
#pragma once

#include <array>
#include <vector>

#include "cloth/grid.h"
#include "shared/tether_types.h"

namespace drape {

/// Returns for every particle, row by row, the nearest particle of each of the two nearest pins, at the distance within
/// the cloth at rest times 1 + `give`. On a whole grid that distance is the straight line; around holes and
/// with `rest_scales` (of the cloth's geometry) it is the shortest path along rows, columns and diagonals (on flat
/// cloth up to 8 % longer than the true one, so never too short). `spacing` is m along columns and rows. There are none
/// without pins, or out of their reach.
std::vector<glsl::ParticleTethers> find_tethers(const Grid& grid, const std::array<double, 2>& spacing,
                                                const std::vector<Pin>& pins, double give,
                                                const std::vector<glsl::vec4>& rest_scales = {});

/// Returns the strain of the cloth hanging by its whole length, rho g l/stretch: a tether gives way by it.
double tether_give(const Cloth& cloth, const Vec3& gravity);

}  // namespace drape
