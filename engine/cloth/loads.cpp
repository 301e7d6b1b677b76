#include "cloth/loads.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "world/weather.h"

namespace drape {

namespace {

template <class Visit>
void for_each_particle(const IndexBox& box, const Visit& visit) {
    for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
        for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column) visit(column, row);
}

double factor_of(const Load& load, std::size_t particle) {
    return load.factors.empty() ? 1.0 : double{load.factors[particle]};
}

/// Returns the area of the cells around a particle, in units of a whole cell's.
double area_around(const Grid& grid, std::uint32_t column, std::uint32_t row) {
    double area = 0;
    for (const int up : {1, 0})
        for (const int left : {1, 0})
            area += grid.cell_area(static_cast<int>(column) - left, static_cast<int>(row) - up);
    return area;
}

/// Adds a pressure, Pa, on the quarters of cells of a load's particles.
void add_pressure(const Grid& grid, const Load& load, double pressure, std::span<const Vec3> at,
                  std::vector<Vec3>& force) {
    for_each_particle(load.particles, [&](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t here = grid.particle(column, row);
        for (const int down : {-1, 1})
            for (const int right : {-1, 1}) {
                const int i = static_cast<int>(column), j = static_cast<int>(row);
                if (grid.cell(i + (right - 1) / 2, j + (down - 1) / 2) == 0) continue;
                const auto beside = static_cast<std::uint32_t>(static_cast<int>(here) + right),
                           below = static_cast<std::uint32_t>(static_cast<int>(here) +
                                                              down * static_cast<int>(grid.columns()));
                const Vec3 area = cross(minus(at[beside], at[here]), minus(at[below], at[here]));
                force[here] = plus(force[here], times(0.25 * right * down * pressure * factor_of(load, here), area));
            }
    });
}

/// Returns what a load's strength is divided by to be the acceleration of all of a cloth: kg, of a pressure kg/m^2.
double loaded_mass(const Cloth& cloth, const Load& load) {
    return cloth.areal_density * (load.presses() ? 1 : cloth.size[0] * cloth.size[1]);
}

}  // namespace

std::vector<double> force_shares(const Grid& grid, const Load& load) {
    std::vector<double> shares(grid.particle_count());
    double sum = 0;
    for_each_particle(load.particles, [&](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t particle = grid.particle(column, row);
        shares[particle] = factor_of(load, particle) * area_around(grid, column, row);
        sum += shares[particle];
    });
    if (sum > 0)
        for_each_particle(load.particles,
                          [&](std::uint32_t column, std::uint32_t row) { shares[grid.particle(column, row)] /= sum; });
    return shares;
}

std::uint32_t load_depth(const Cloth& cloth) {
    if (cloth.loads.empty()) return 0;
    std::vector<std::uint32_t> counts(std::size_t{cloth.grid[0]} * cloth.grid[1]);
    for (const Load& load : cloth.loads)
        for_each_particle(load.particles, [&](std::uint32_t column, std::uint32_t row) {
            ++counts[std::size_t{row} * cloth.grid[0] + column];
        });
    return std::ranges::max(counts);
}

std::vector<glsl::vec4> load_texels(const Cloth& cloth, const Grid& grid) {
    const std::uint32_t depth = load_depth(cloth);
    std::vector<glsl::vec4> texels(depth * grid.particle_count(), {-1, 0, 0, 0});
    std::vector<std::uint32_t> counts(grid.particle_count());
    for (std::size_t number = 0; number < cloth.loads.size(); ++number) {
        const Load& load = cloth.loads[number];
        const std::vector<double> shares = force_shares(grid, load);
        for_each_particle(load.particles, [&](std::uint32_t column, std::uint32_t row) {
            const std::uint32_t particle = grid.particle(column, row);
            texels[depth * particle + counts[particle]++] = {static_cast<float>(number),
                                                             static_cast<float>(shares[particle]),
                                                             static_cast<float>(factor_of(load, particle)), 0};
        });
    }
    return texels;
}

std::vector<Vec3> load_forces(const Cloth& cloth, const Grid& grid, std::span<const Vec3> at, double time) {
    std::vector<Vec3> force(grid.particle_count(), Vec3{});
    for (const Load& load : cloth.loads) {
        if (load.presses()) {
            add_pressure(grid, load, pressure_at(load, time), at, force);
            continue;
        }
        const std::vector<double> shares = force_shares(grid, load);
        for (std::size_t k = 0; k < shares.size(); ++k)
            force[k] = plus(force[k], times(shares[k], force_at(load, time)));
    }
    return force;
}

double load_acceleration(const Cloth& cloth, double time) {
    double sum = 0;
    for (const Load& load : cloth.loads)
        sum += (load.presses() ? std::abs(pressure_at(load, time)) : length(force_at(load, time))) /
               loaded_mass(cloth, load);
    return sum;
}

double most_load_acceleration(const Cloth& cloth) {
    double sum = 0;
    for (const Load& load : cloth.loads) sum += strongest(load) / loaded_mass(cloth, load);
    return sum;
}

std::vector<double> local_load_masses(const Cloth& cloth) {
    const auto [dx, dy] = grid_spacing(cloth);
    const Grid grid(cloth);
    std::vector<double> masses;
    for (const Load& load : cloth.loads) {
        double quarters = 0, most = 0;
        for_each_particle(load.particles, [&](std::uint32_t column, std::uint32_t row) {
            const double factor = factor_of(load, grid.particle(column, row));
            const double area = area_around(grid, column, row);
            quarters += factor * area;
            if (area > 0) most = std::max(most, factor);
        });
        masses.push_back(cloth.areal_density * (load.presses() ? 1 : 0.25 * dx * dy * quarters) / most);
    }
    return masses;
}

}  // namespace drape
