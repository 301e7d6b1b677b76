// Which share of its loads each particle of a cloth has (docs/physics.md 10). Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/grid.h"

namespace drape {

/// Returns each particle's share of a load's force: by its area, a quarter of each cell that it has, times the load's
/// factor. They add up to 1, or are all 0 where no particle of the load has a cell.
std::vector<double> force_shares(const Grid& grid, const Load& load);
/// Returns the largest number of loads on a particle.
std::uint32_t load_depth(const Cloth& cloth);
/// Returns `load_depth` texels for each particle, row by row: the number of a load among the cloth's, -1 for none; the
/// particle's share of its force; the factor of its pressure.
std::vector<glsl::vec4> load_texels(const Cloth& cloth, const Grid& grid);
/// Returns what a cloth's loads give to each particle in a shape, N, at a time, s.
std::vector<Vec3> load_forces(const Cloth& cloth, const Grid& grid, std::span<const Vec3> at, double time);
/// Returns the acceleration, m/s^2, that all loads of a time (s) give to a cloth that does not stretch; and at most.
double load_acceleration(const Cloth& cloth, double time);
double most_load_acceleration(const Cloth& cloth);
/// Returns by load what its strength is divided by to be the largest acceleration of a particle which nothing else
/// holds: kg, of a pressure kg/m^2.
std::vector<double> local_load_masses(const Cloth& cloth);

}  // namespace drape
