// Measures a twin's cloth in double precision: positions with the part that rounding kept, energies, momentum.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "twin/twin.h"

namespace drape::test {

inline Vec3 position_of(const TwinCloth& state, std::size_t i) {
    const glsl::vec4 x = state[Field::position][i], rest = state[Field::position_remainder][i];
    return {double(x.x) + double(rest.x), double(x.y) + double(rest.y), double(x.z) + double(rest.z)};
}

inline Vec3 displacement_of(const TwinCloth& state, std::size_t i) {
    const glsl::vec4 d = state[Field::displacement][i];
    return {double(d.x), double(d.y), double(d.z)};
}

inline double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Calls visit(first, second, direction, share) for every spring of a cloth.
template <class Visit>
void for_springs(const ClothModel& model, const Visit& visit) {
    const glsl::ivec2 size = model.grid.size();
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glsl::ivec2 offset = spring_directions[direction].offset, to{x + offset.x, y + offset.y};
                if (to.x < 0 || to.x >= size.x || to.y >= size.y) continue;
                const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
                const glsl::vec4 shares = model.grid.spring_shares(column, row);
                const float share[4] = {shares.x, shares.y, shares.z, shares.w};
                visit(model.grid.particle(column, row),
                      model.grid.particle(static_cast<std::uint32_t>(to.x), static_cast<std::uint32_t>(to.y)),
                      direction, static_cast<double>(share[direction]));
            }
}

/// Mass of a particle, kg; 0 without a cell.
inline double mass_of(const ClothModel& model, std::size_t i) {
    const float w = model.free_weight[i];
    return w > 0 ? model.inner_mass / static_cast<double>(w) : 0.0;
}

/// Calls visit(first, middle, third, axis, share) for every bending element of a cloth.
template <class Visit>
void for_bends(const ClothModel& model, const Visit& visit) {
    const glsl::ivec2 size = model.grid.size();
    for (std::size_t axis = 0; axis < bend_axes.size(); ++axis)
        for (int y = bend_axes[axis].offset.y; y + bend_axes[axis].offset.y < size.y; ++y)
            for (int x = bend_axes[axis].offset.x; x + bend_axes[axis].offset.x < size.x; ++x) {
                const auto particle = [&](int k) {
                    return glsl::ivec2{x + k * bend_axes[axis].offset.x, y + k * bend_axes[axis].offset.y};
                };
                const auto index = [&](glsl::ivec2 p) {
                    return model.grid.particle(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y));
                };
                const auto share = [&](glsl::ivec2 p) {
                    const glsl::vec4 shares =
                        model.grid.spring_shares(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y));
                    return static_cast<double>(axis == 0 ? shares.x : shares.y);
                };
                visit(index(particle(-1)), index(particle(0)), index(particle(1)), axis,
                      std::min(share(particle(-1)), share(particle(0))));
            }
}

/// Calls visit(corners 00 10 01 11) for every whole cell, since only those twist.
template <class Visit>
void for_twists(const ClothModel& model, const Visit& visit) {
    const glsl::ivec2 size = model.grid.size();
    for (int y = 0; y + 1 < size.y; ++y)
        for (int x = 0; x + 1 < size.x; ++x) {
            if (model.grid.cell(x, y) != (upper_triangle | lower_triangle)) continue;
            const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
            const std::uint32_t first = model.grid.particle(column, row);
            visit(std::array<std::size_t, 4>{first, first + 1, first + model.grid.columns(),
                                             first + model.grid.columns() + 1});
        }
}

struct Energy {
    double kinetic = 0, gravity = 0, elastic = 0, bending = 0;
    double total() const { return kinetic + gravity + elastic + bending; }
};

/// Energy in J, with the stiffness that the solver uses. The velocity is the last substep's mean, half a substep early.
inline Energy energy_of(const SimulationModel& scene, std::size_t cloth, const TwinCloth& state) {
    const ClothModel& model = scene.cloths[cloth];
    Energy energy;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const Vec3 x = position_of(state, i), d = displacement_of(state, i);
        const double m = mass_of(model, i), h = model.substep_length;
        for (std::size_t k = 0; k < 3; ++k) {
            energy.kinetic += 0.5 * m * d[k] * d[k] / (h * h);
            energy.gravity -= m * scene.scene.gravity[k] * x[k];
        }
    }
    for_springs(model, [&](std::size_t first, std::size_t second, std::size_t direction, double share) {
        const double stretch = distance(position_of(state, first), position_of(state, second)) -
                               model.stiffness_constant.rest_length[direction];
        energy.elastic += 0.5 * share * model.scheme.used_stiffness[direction] * stretch * stretch;
    });
    const double wanted = scene.scene.cloths[cloth].stiffness.bend.largest();
    const double used = wanted > 0 ? model.scheme.used_bend / wanted : 0;
    for_bends(model, [&](std::size_t first, std::size_t middle, std::size_t third, std::size_t axis, double share) {
        const Vec3 a = position_of(state, first), b = position_of(state, middle), c = position_of(state, third);
        const double difference = std::hypot(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1], a[2] - 2 * b[2] + c[2]);
        energy.bending += 0.5 * share * model.stiffness_constant.bend[axis] * used * difference * difference;
    });
    for_twists(model, [&](const std::array<std::size_t, 4>& corner) {
        Vec3 twist{};
        for (std::size_t n = 0; n < 4; ++n)
            for (std::size_t k = 0; k < 3; ++k)
                twist[k] += (n == 0 || n == 3 ? 1 : -1) * position_of(state, corner[n])[k];
        const double squared = twist[0] * twist[0] + twist[1] * twist[1] + twist[2] * twist[2];
        energy.bending += 0.5 * model.stiffness_constant.twist * used * squared;
    });
    return energy;
}

}  // namespace drape::test
