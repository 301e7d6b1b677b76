// Energies of a spring network with their first and second derivatives, by the plain definition, spring by spring. The
// fast kernel of network_kernel.h is tested against it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/vectors.h"
#include "reference/spring_network.h"
#include "world/gas.h"
#include "world/gust.h"
#include "world/weather.h"

namespace drape {

namespace {

Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
void add_scaled(Vec3& sum, double factor, const Vec3& v) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += factor * v[k];
}

Vec3 second_difference(const BendingElement& element, std::span<const Vec3> position) {
    Vec3 sum{};
    for (std::size_t k = 0; k < 4; ++k) add_scaled(sum, element.coefficient[k], position[element.particle[k]]);
    return sum;
}

/// Returns the volume that faces close in, m^3.
double volume_in(const NetworkGas& gas, std::span<const Vec3> position) {
    double sum = 0;
    for (const auto& [a, b, c, d] : gas.faces)
        for (const auto& [u, v, w] : {std::array{a, b, d}, {b, c, a}, {c, d, b}, {d, a, c}})
            sum += dot(position[u], cross(position[v], position[w]));
    return sum / 12;
}

/// Adds a 3x3 block at particles (p, q), p != q taken once into the lower triangle.
template <class Block>
void add_block(std::vector<HessianEntry>& entries, std::uint32_t p, std::uint32_t q, const Block& block) {
    const std::uint32_t row = std::max(p, q), column = std::min(p, q);
    for (std::uint32_t r = 0; r < 3; ++r)
        for (std::uint32_t c = 0; c < (p == q ? r + 1 : 3); ++c)
            entries.push_back({3 * row + r, 3 * column + c, block(r, c)});
}

}  // namespace

double SpringNetwork::kinetic_energy(std::span<const Vec3> velocity) const {
    double energy = 0;
    for (std::size_t p = 0; p < mass.size(); ++p) energy += 0.5 * mass[p] * dot(velocity[p], velocity[p]);
    return energy;
}

double SpringNetwork::gravity_energy(std::span<const Vec3> position) const {
    double energy = 0;
    for (std::size_t p = 0; p < mass.size(); ++p) energy -= mass[p] * dot(gravity, position[p]);
    return energy;
}

double SpringNetwork::spring_energy(std::span<const Vec3> position) const {
    double energy = 0;
    for (const NetworkSpring& spring : springs) {
        const double size = length(position[spring.second] - position[spring.first]);
        const double stretch = size - spring.rest_length;
        energy += 0.5 * spring.stiffness_at(size) * stretch * stretch;
    }
    return energy;
}

double SpringNetwork::bending_energy(std::span<const Vec3> position) const {
    double energy = 0;
    for (const BendingElement& element : bending) {
        const Vec3 difference = second_difference(element, position);
        energy += 0.5 * element.stiffness * dot(difference, difference);
    }
    return energy;
}

double SpringNetwork::potential_energy(std::span<const Vec3> position) const {
    return gravity_energy(position) + spring_energy(position) + bending_energy(position);
}

std::vector<Vec3> SpringNetwork::gradient(std::span<const Vec3> position) const {
    std::vector<Vec3> result(particle_count(), Vec3{});
    for (std::size_t p = 0; p < mass.size(); ++p) add_scaled(result[p], -mass[p], gravity);
    for (const NetworkSpring& spring : springs) {
        const Vec3 edge = position[spring.second] - position[spring.first];
        const double size = length(edge);
        if (size == 0) continue;  // without a direction it is a stationary, unstable point
        const double factor = spring.stiffness_at(size) * (1 - spring.rest_length / size);
        add_scaled(result[spring.first], -factor, edge);
        add_scaled(result[spring.second], factor, edge);
    }
    for (const BendingElement& element : bending) {
        const Vec3 difference = second_difference(element, position);
        for (std::size_t k = 0; k < 4; ++k)
            add_scaled(result[element.particle[k]], element.stiffness * element.coefficient[k], difference);
    }
    return result;
}

Vec3 SpringNetwork::more_gravity(double time) const { return value_at(gravity_keys, gravity, time) - gravity; }

void SpringNetwork::add_outer_forces(std::span<const Vec3> position, std::span<const Vec3> velocity, double time,
                                     std::span<Vec3> force) const {
    add_wind_force(position, velocity, time, force);
    add_load_forces(position, time, force);
    add_gas_forces(position, time, force);
}

void SpringNetwork::add_gas_forces(std::span<const Vec3> position, double time, std::span<Vec3> force) const {
    for (const NetworkGas& each : gas) {
        const double pressure = gas_pressure(each.gas, time, volume_in(each, position));
        for (const auto& [a, b, c, d] : each.faces)
            for (const auto& [p, q, r, s] : {std::array{a, b, c, d}, {b, c, d, a}, {c, d, a, b}, {d, a, b, c}})
                for (const auto& [u, v] : {std::pair{q, s}, {q, r}, {r, s}})
                    add_scaled(force[p], pressure / 12, cross(position[u], position[v]));
    }
}

double SpringNetwork::gas_energy(std::span<const Vec3> position, double time) const {
    double energy = 0;
    for (const NetworkGas& each : gas) {
        const double volume = volume_in(each, position);
        energy += each.gas.ambient * (volume - gas_at(each.gas, time) * std::log(volume));
    }
    return energy;
}

void SpringNetwork::add_load_forces(std::span<const Vec3> position, double time, std::span<Vec3> force) const {
    for (const NetworkLoad& load : loads) {
        const Vec3 pull = force_at(load.load, time);
        for (std::size_t p = 0; p < force.size(); ++p) add_scaled(force[p], load.share[p], pull);
        const double pressure = pressure_at(load.load, time);
        if (pressure == 0) continue;
        for (const auto& [particle, in_row, in_column] : quarters) {
            const Vec3 normal = cross(position[in_row] - position[particle], position[in_column] - position[particle]);
            const double turned = (in_row > particle) == (in_column > particle) ? 0.25 : -0.25;
            add_scaled(force[particle], turned * pressure * load.factor[particle], normal);
        }
    }
}

void SpringNetwork::add_wind_force(std::span<const Vec3> position, std::span<const Vec3> velocity, double time,
                                   std::span<Vec3> force) const {
    if (!wind.blows()) return;
    const Vec3 air = wind_velocity(wind, time);
    for (const auto& [particle, in_row, in_column] : quarters) {
        Vec3 normal = cross(position[in_row] - position[particle], position[in_column] - position[particle]);
        const double cell = length(normal);
        if (!(cell > 0)) continue;
        const Vec3 relative = air - velocity[particle];
        for (double& component : normal) component /= cell;
        const double along = dot(relative, normal);
        const double half_density_area = 0.5 * wind.air_density * cell / 4;
        add_scaled(force[particle], half_density_area * (wind.drag - wind.lift) * std::abs(along), relative);
        add_scaled(force[particle], half_density_area * wind.lift * dot(relative, relative) * (along < 0 ? -1 : 1),
                   normal);
    }
}

std::vector<HessianEntry> SpringNetwork::hessian(std::span<const Vec3> position, HessianForm form) const {
    std::vector<HessianEntry> entries;
    entries.reserve(21 * springs.size() + 54 * bending.size());
    for (const NetworkSpring& spring : springs) {
        const Vec3 edge = position[spring.second] - position[spring.first];
        const double size = length(edge);
        const Vec3 n = size > 0 ? Vec3{edge[0] / size, edge[1] / size, edge[2] / size} : Vec3{};
        double across = size > 0 ? 1 - spring.rest_length / size : 0.0;
        if (form == HessianForm::clamped) across = std::max(across, 0.0);
        const auto block = [&](double sign) {
            return [&, sign](std::uint32_t r, std::uint32_t c) {
                return sign * spring.stiffness_at(size) * ((1 - across) * n[r] * n[c] + (r == c ? across : 0.0));
            };
        };
        add_block(entries, spring.first, spring.first, block(1));
        add_block(entries, spring.second, spring.second, block(1));
        add_block(entries, spring.first, spring.second, block(-1));
    }
    for (const BendingElement& element : bending)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                const double value = element.stiffness * element.coefficient[i] * element.coefficient[j];
                if (value == 0) continue;
                for (std::uint32_t k = 0; k < 3; ++k)
                    entries.push_back({3 * std::max(element.particle[i], element.particle[j]) + k,
                                       3 * std::min(element.particle[i], element.particle[j]) + k, value});
            }
    return entries;
}

NetworkStrain SpringNetwork::strain(std::span<const Vec3> position, SpringFamily family) const {
    NetworkStrain result;
    double squares = 0;
    for (const NetworkSpring& spring : springs) {
        if (spring.family != family) continue;
        const double value = length(position[spring.second] - position[spring.first]) / spring.rest_length - 1;
        squares += value * value;
        result.max = result.count == 0 ? value : std::max(result.max, value);
        result.min = result.count == 0 ? value : std::min(result.min, value);
        ++result.count;
    }
    if (result.count > 0) result.rms = std::sqrt(squares / static_cast<double>(result.count));
    return result;
}

}  // namespace drape
