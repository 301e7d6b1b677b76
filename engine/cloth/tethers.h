// Tethers (long-range attachments) say on which held particles a free one hangs, and how far from them it may be.
#pragma once

#include <array>
#include <vector>

#include "cloth/grid.h"
#include "shared/tether_types.h"

namespace drape {

/// Returns for every particle, row by row, the nearest particle of each of the two nearest pins, with the distance
/// within the cloth at rest times 1 + `give`. On a whole grid this distance is a straight line. Around holes, and with
/// `rest_scales` (of the cloth's geometry), it is the shortest path along rows, columns and diagonals, which on flat
/// cloth is up to 8 % longer than the true distance and never shorter. `spacing` is m along columns and rows. A
/// particle without pins within reach gets no tether.
std::vector<glsl::ParticleTethers> find_tethers(const Grid& grid, const std::array<double, 2>& spacing,
                                                const std::vector<Pin>& pins, double give,
                                                const std::vector<glsl::vec4>& rest_scales = {});

/// Returns the strain of the cloth when it hangs by its whole length, rho g l/stretch, by which a tether gives way.
double tether_give(const Cloth& cloth, const Vec3& gravity);

}  // namespace drape
