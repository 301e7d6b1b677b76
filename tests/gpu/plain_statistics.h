// The statistics of a state, evaluated plainly in double precision.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/vectors.h"
#include "cloth/texels.h"
#include "run/run_statistics.h"
#include "support/sheet_state.h"
#include "twin/twin.h"
#include "world/start.h"

namespace drape::test {

inline double distance(const glsl::vec4& a, const glsl::vec4& b) {
    return std::hypot(double(b.x) - double(a.x), double(b.y) - double(a.y), double(b.z) - double(a.z));
}

/// Strain and elastic energy of the springs of `family`, spring by spring in double precision.
inline StrainStatistics plain_strain(const SceneDescription& scene, const ClothModel& model, const TwinCloth& state,
                                     SpringFamily family, double& energy, double& squared_error, double& worst_error) {
    const Stiffness& stiffness = scene.cloths[0].stiffness;
    const double dx = model.spacing[0], dy = model.spacing[1];
    StrainStatistics strain{0, 0, -1e300, 1e300};
    for (std::size_t direction = 0; direction < 4; ++direction) {
        if (spring_directions[direction].family != family) continue;
        const auto [i, j] = spring_directions[direction].offset;
        const std::vector<std::array<double, 4>> ratios = rest_ratios(scene.cloths[0]);
        const double k = family == SpringFamily::shear ? stiffness.shear * (dx * dx + dy * dy) / (2 * dx * dy)
                         : j == 0                      ? stiffness.stretch.warp * dy / dx
                                                       : stiffness.stretch.weft * dx / dy;
        for (int row = 0; row < model.grid.size().y; ++row)
            for (int column = 0; column < model.grid.size().x; ++column) {
                if (column + i < 0 || column + i >= model.grid.size().x || row + j >= model.grid.size().y) continue;
                const glsl::vec4 shares =
                    model.grid.spring_shares(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
                const float all[] = {shares.x, shares.y, shares.z, shares.w};
                if (all[direction] == 0) continue;
                const double rest = std::hypot(i * dx, j * dy) * ratios[at(model.grid, {column, row})][direction];
                const double length = distance(state[Field::position][at(model.grid, {column, row})],
                                               state[Field::position][at(model.grid, {column + i, row + j})]);
                const double value = (length - rest) / rest;
                ++strain.spring_count;
                strain.rms += value * value;
                strain.largest = std::max(strain.largest, value);
                strain.smallest = std::min(strain.smallest, value);
                const double acting = length < rest ? stiffness.compression : 1;
                if (family == SpringFamily::stretch) {
                    const double error =
                        acting * value - state.tension(direction)[at(model.grid, {column, row})] / rest;
                    squared_error += error * error;
                    worst_error = std::max(worst_error, std::abs(error));
                }
                if (!stiffness.rigid) energy += 0.5 * k * acting * all[direction] * (length - rest) * (length - rest);
            }
    }
    strain.rms = std::sqrt(strain.rms / strain.spring_count);
    return strain;
}

/// An edge, or a sum of edges, at rest and now, m.
struct PlainEdge {
    Vec3 rest{}, now{};
    PlainEdge plus(const PlainEdge& other, double sign) const {
        return {drape::plus(rest, times(sign, other.rest)), drape::plus(now, times(sign, other.now))};
    }
};

/// Bending energy, element by element in double precision (docs/physics.md 4), of cloth that spans a plane where it
/// rests bent.
class PlainBending {
  public:
    PlainBending(const SceneDescription& scene, const ClothModel& model, const TwinCloth& state)
        : cloth_(scene.cloths[0]), model_(model), state_(state) {}

    double energy() const {
        const double dx = model_.spacing[0], dy = model_.spacing[1];
        const Rigidity& rigidity = cloth_.stiffness.bend;
        double doubled = 0;
        for (int y = 0; y < model_.grid.size().y; ++y)
            for (int x = 0; x < model_.grid.size().x; ++x) {
                const PlainEdge row = side(x, y, 1, 0).plus(side(x, y, -1, 0), -1),
                                column = side(x, y, 0, 1).plus(side(x, y, 0, -1), -1);
                const double along_row = std::min(share(x, y, 1, 0), share(x, y, -1, 0)),
                             along_column = std::min(share(x, y, 0, 1), share(x, y, 0, -1));
                if (along_row > 0)
                    doubled += rigidity.warp * dy / (dx * dx * dx) * along_row *
                               squared_beyond(edge(x, y, 1, 0).plus(edge(x, y, -1, 0), 1), row, column);
                if (along_column > 0)
                    doubled += rigidity.weft * dx / (dy * dy * dy) * along_column *
                               squared_beyond(edge(x, y, 0, 1).plus(edge(x, y, 0, -1), 1), row, column);
                if (!has(x + 1, y + 1) || model_.grid.cell(x, y) != (upper_triangle | lower_triangle)) continue;
                const PlainEdge upper = edge(x, y, 1, 0), lower = edge(x, y + 1, 1, 0);
                doubled += 2 * rigidity.twist / (dx * dy) * double{shares(x, y).z} *
                           squared_beyond(upper.plus(lower, -1), upper.plus(lower, 1),
                                          edge(x, y, 0, 1).plus(edge(x + 1, y, 0, 1), 1));
            }
        return doubled / 2;
    }

  private:
    bool has(int x, int y) const { return x >= 0 && y >= 0 && x < model_.grid.size().x && y < model_.grid.size().y; }
    glsl::vec4 shares(int x, int y) const {
        return model_.grid.spring_shares(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }
    double share(int x, int y, int i, int j) const {
        if (!has(x + i, y + j)) return 0;
        const glsl::vec4 all = shares(x + std::min(i, 0), y + std::min(j, 0));
        return i != 0 ? double{all.x} : double{all.y};
    }
    static Vec3 between(const glsl::vec4& a, const glsl::vec4& b) {
        return {double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}};
    }
    PlainEdge edge(int x, int y, int i, int j) const {
        const std::size_t from = at(model_.grid, {x, y}), to = at(model_.grid, {x + i, y + j});
        return {between(model_.position[from], model_.position[to]),
                between(state_[Field::position][from], state_[Field::position][to])};
    }
    PlainEdge side(int x, int y, int i, int j) const { return share(x, y, i, j) > 0 ? edge(x, y, i, j) : PlainEdge{}; }
    double squared_beyond(const PlainEdge& difference, const PlainEdge& row, const PlainEdge& column) const {
        Vec3 beyond = difference.now;
        if (cloth_.rest == Rest::start) {
            const Vec3 normal = cross(row.rest, column.rest);
            const double volume = dot(normal, normal);
            const double along_row = dot(difference.rest, cross(column.rest, normal)) / volume,
                         along_column = dot(difference.rest, cross(normal, row.rest)) / volume,
                         across = dot(difference.rest, normal) / volume;
            beyond = minus(beyond, plus(plus(times(along_row, row.now), times(along_column, column.now)),
                                        times(across, cross(row.now, column.now))));
        }
        return dot(beyond, beyond);
    }

    const Cloth& cloth_;
    const ClothModel& model_;
    const TwinCloth& state_;
};

inline Vec3 start_of(const ClothModel& cloth, std::size_t particle) {
    const glsl::vec4& at = cloth.position[particle];
    return {double{at.x}, double{at.y}, double{at.z}};
}

/// Everything but penetration, evaluated plainly in double precision from the scene and the state.
inline ClothStatistics plain_statistics(const SceneDescription& scene, const SimulationModel& model,
                                        const TwinCloth& state) {
    const ClothModel& cloth = model.cloths[0];
    ClothStatistics plain;
    double squared_error = 0;
    plain.stretch = plain_strain(scene, cloth, state, SpringFamily::stretch, plain.elastic_energy, squared_error,
                                 plain.stretch_error_max);
    plain.stretch_error_rms = std::sqrt(squared_error / plain.stretch.spring_count);
    plain.shear = plain_strain(scene, cloth, state, SpringFamily::shear, plain.elastic_energy, squared_error,
                               plain.stretch_error_max);
    plain.elastic_energy += PlainBending(scene, cloth, state).energy();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const float weight = cloth.free_weight[i];
        const double mass = weight > 0 ? cloth.inner_mass / double(weight) : 0;
        const glsl::vec4 x = state[Field::position][i], d = state[Field::displacement][i],
                         e = state[Field::end_excess][i];
        const double speed =
            std::hypot(double(d.x) + double(e.x), double(d.y) + double(e.y), double(d.z) + double(e.z)) /
            cloth.substep_length;
        const double at[] = {x.x, x.y, x.z};
        plain.kinetic_energy += 0.5 * mass * speed * speed;
        plain.mass += mass;
        const double moved[] = {double(d.x) + double(e.x), double(d.y) + double(e.y), double(d.z) + double(e.z)};
        for (std::size_t k = 0; k < 3; ++k) plain.momentum[k] += mass * moved[k] / cloth.substep_length;
        for (std::size_t k = 0; k < 3; ++k) {
            plain.potential_energy -= mass * scene.gravity[k] * at[k];
            plain.center_of_mass[k] += mass * at[k];
        }
        plain.largest_distance = std::max(plain.largest_distance, std::hypot(at[0], at[1], at[2]));
        plain.largest_speed = std::max(plain.largest_speed, speed);
    }
    for (double& coordinate : plain.center_of_mass) coordinate /= plain.mass;
    const bool on_pin = cloth.turn && cloth.turn->turns_held();
    const glsl::ivec2 about = cloth.turn.value_or(KeptTurn{}).about;
    const std::size_t pin =
        cloth.grid.particle(static_cast<std::uint32_t>(about.x), static_cast<std::uint32_t>(about.y));
    const Vec3 point = on_pin ? start_of(cloth, pin) : plain.center_of_mass;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const Vec3 moved = times(mass_of(cloth, i) / cloth.substep_length, displacement_of(state, i));
        plain.angular_momentum = plus(plain.angular_momentum, cross(minus(position_of(state, i), point), moved));
    }
    return plain;
}

/// Momenta may cancel, so their error is relative to the motion of all of the mass.
inline void expect_momenta(const ClothStatistics& statistics, const ClothStatistics& plain) {
    const double moving = 1e-5 * std::sqrt(2 * plain.kinetic_energy * plain.mass);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(statistics.momentum[k], plain.momentum[k], moving);
        EXPECT_NEAR(statistics.angular_momentum[k], plain.angular_momentum[k], moving * plain.largest_distance);
    }
}

}  // namespace drape::test
