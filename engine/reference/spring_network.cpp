#include "reference/spring_network.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cloth/grid.h"
#include "reference/stable_hash.h"
#include "world/cloth_keys.h"
#include "world/motion.h"
#include "world/start.h"
#include "world/weather.h"

namespace drape {

namespace {

Vec3 transformed(const RigidTransform& motion, const Vec3& pivot, const Vec3& rest) {
    Vec3 result;
    for (std::size_t k = 0; k < 3; ++k) {
        result[k] = pivot[k] + motion.translation[k];
        for (std::size_t c = 0; c < 3; ++c) result[k] += motion.rotation[3 * k + c] * (rest[c] - pivot[c]);
    }
    return result;
}

/// Half the number of sides of a line of particles that are cloth. `left` and `right` are the cells on either side of
/// the middle particle on one side of the line; a hole on either ends the cloth there.
double bending_share(bool left_above, bool right_above, bool left_below, bool right_below) {
    return 0.5 * (left_above && right_above) + 0.5 * (left_below && right_below);
}

/// Returns what of a key's value the network cannot follow; null: it has it, or it is not about springs and air.
const char* unsupported(ClothKey key, const Cloth& cloth) {
    switch (key) {
        case ClothKey::stiffness:
            return cloth.stiffness.rigid ? "rigid springs have no energy to refer to" : nullptr;
        case ClothKey::stiffness_keys:
            return cloth.stiffness_keys.empty() ? nullptr
                                                : "the double-precision reference knows no stiffness that changes";
        case ClothKey::rest:
            return cloth.rest == Rest::start && cloth.stiffness.bend.largest() > 0
                       ? "the double-precision reference knows no bending that is at rest when bent"
                       : nullptr;
        case ClothKey::panel:
            return !cloth.panel.empty() && cloth.stiffness.bend.largest() > 0
                       ? "the double-precision reference knows no bending of an outline's uneven rim"
                       : nullptr;
        case ClothKey::name:
        case ClothKey::grid:
        case ClothKey::size:
        case ClothKey::placement:
        case ClothKey::start:
        case ClothKey::areal_density:
        case ClothKey::damping:
        case ClothKey::velocity:
        case ClothKey::velocities:
        case ClothKey::holes:
        case ClothKey::cell_stiffness:
        case ClothKey::cell_density:
        case ClothKey::pins:
        case ClothKey::loads:
        case ClothKey::appearance:
        // Contact and tears are left out.
        case ClothKey::friction:
        case ClothKey::thickness:
        case ClothKey::contact:
        case ClothKey::self_collision:
        case ClothKey::particle_friction:
        case ClothKey::particle_thickness:
        case ClothKey::tear:
        case ClothKey::cell_tear:
            return nullptr;
    }
    return nullptr;
}

void check_supported(const SceneDescription& scene, const Cloth& cloth, const NetworkOptions& options) {
    for (const ClothKey key : cloth_keys)
        if (const char* what = unsupported(key, cloth))
            throw std::invalid_argument("cloth \"" + cloth.name + "\": " + what);
    if (!scene.colliders.empty() && !options.ignore_colliders)
        throw std::invalid_argument("scene \"" + scene.name + "\": the double-precision reference knows no colliders");
}

}  // namespace

SpringNetwork::SpringNetwork(const SceneDescription& scene, std::size_t cloth_index, const NetworkOptions& options)
    : start_velocity(scene.cloths.at(cloth_index).velocity),
      start_velocities(scene.cloths[cloth_index].velocities),
      gravity(gravity_at(scene, 0)),
      gravity_keys(scene.gravity_keys),
      damping(scene.cloths[cloth_index].damping),
      wind(scene.wind) {
    const Cloth& cloth = scene.cloths[cloth_index];
    check_supported(scene, cloth, options);
    const Grid grid(cloth);
    place(cloth, grid);
    hold_pins(cloth, grid);
    add_springs(cloth, grid);
    add_bending(cloth, grid);
    for (std::uint32_t row = 0; row + 1 < grid.rows(); ++row)
        for (std::uint32_t column = 0; column + 1 < grid.columns(); ++column) {
            if (grid.cell(static_cast<int>(column), static_cast<int>(row)) == 0) continue;
            for (const std::uint32_t down : {0u, 1u})
                for (const std::uint32_t right : {0u, 1u})
                    quarters.push_back({grid.particle(column + right, row + down),
                                        grid.particle(column + 1 - right, row + down),
                                        grid.particle(column + right, row + 1 - down)});
        }
    for (const Load& load : cloth.loads) add_load(load, grid);
}

void SpringNetwork::place(const Cloth& cloth, const Grid& grid) {
    const auto [dx, dy] = grid_spacing(cloth);
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            mass.push_back(0.25 * grid.cell_masses(column, row) * cloth.areal_density * dx * dy);
            rest_position.push_back(start_place(cloth, column, row));
        }
    pin_of.assign(mass.size(), -1);
}

void SpringNetwork::hold_pins(const Cloth& cloth, const Grid& grid) {
    for (std::size_t index = 0; index < cloth.pins.size(); ++index) {
        const IndexBox& box = cloth.pins[index].particles;
        for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
            for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column)
                pin_of[grid.particle(column, row)] = static_cast<std::int32_t>(index);  // a later pin overrides
    }
    for (std::size_t index = 0; index < cloth.pins.size(); ++index) {
        Vec3 centroid{};
        double count = 0;
        for (std::size_t p = 0; p < pin_of.size(); ++p) {
            if (pin_of[p] != static_cast<std::int32_t>(index)) continue;
            for (std::size_t k = 0; k < 3; ++k) centroid[k] += rest_position[p][k];
            ++count;
        }
        for (double& c : centroid) c /= std::max(count, 1.0);
        const Pin& pin = cloth.pins[index];
        pins.push_back({pin.path, pin.pivot.value_or(centroid), pin.release});
    }
}

void SpringNetwork::add_load(const Load& load, const Grid& grid) {
    NetworkLoad added{load, std::vector<double>(particle_count()), std::vector<double>(particle_count())};
    double sum = 0;
    for (const auto& quarter : quarters) {
        const std::uint32_t p = quarter[0], column = p % grid.columns(), row = p / grid.columns();
        const auto& [first, last] = load.particles;
        if (column < first[0] || row < first[1] || column > last[0] || row > last[1]) continue;
        added.factor[p] = load.factors.empty() ? 1.0 : double{load.factors[p]};
        added.share[p] += added.factor[p];
        sum += added.factor[p];
    }
    for (double& share : added.share) share /= std::max(sum, 1e-300);
    loads.push_back(std::move(added));
}

void SpringNetwork::add_springs(const Cloth& cloth, const Grid& grid) {
    const auto [dx, dy] = grid_spacing(cloth);
    const double stiffness[4] = {cloth.stiffness.stretch.warp * dy / dx, cloth.stiffness.stretch.weft * dx / dy,
                                 cloth.stiffness.shear * (dx * dx + dy * dy) / (2 * dx * dy),
                                 cloth.stiffness.shear * (dx * dx + dy * dy) / (2 * dx * dy)};
    const double rest[4] = {dx, dy, std::hypot(dx, dy), std::hypot(dx, dy)};
    const std::vector<std::array<double, 4>> ratios = rest_ratios(cloth);
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
        const SpringDirection& table = spring_directions[direction];
        for (std::uint32_t row = 0; row < grid.rows(); ++row)
            for (std::uint32_t column = 0; column < grid.columns(); ++column) {
                const glsl::vec4 shares = grid.spring_shares(column, row);
                const double share = double((&shares.x)[direction]);
                if (share == 0 || stiffness[direction] == 0) continue;
                const std::uint32_t first = grid.particle(column, row);
                const auto step = table.offset.y * static_cast<int>(grid.columns()) + table.offset.x;
                springs.push_back({first, static_cast<std::uint32_t>(static_cast<int>(first) + step),
                                   share * stiffness[direction], ratios[first][direction] * rest[direction],
                                   table.family, cloth.stiffness.compression});
            }
    }
}

void SpringNetwork::add_bending(const Cloth& cloth, const Grid& grid) {
    const Rigidity& rigidity = cloth.stiffness.bend;
    if (rigidity.largest() == 0) return;
    const auto [dx, dy] = grid_spacing(cloth);
    const auto present = [&grid](int i, int j) { return grid.cell(i, j) != 0; };
    // Where cells differ, three particles bend as the softer of their two springs pulls.
    const bool mapped = !cloth.cell_stiffness.empty();
    const auto share = [&grid](std::uint32_t at) {
        return grid.spring_shares(at % grid.columns(), at / grid.columns());
    };
    const auto add = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, double constant, double h, double across) {
        if (constant > 0) bending.push_back({{p, q, r, q}, {1, -2, 1, 0}, constant * across / (h * h * h)});
    };
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const int i = static_cast<int>(column), j = static_cast<int>(row);
            const std::uint32_t p = grid.particle(column, row), down = grid.columns();
            const bool cells[4] = {present(i - 1, j - 1), present(i, j - 1), present(i - 1, j), present(i, j)};
            if (column > 0 && column + 1 < grid.columns())
                add(p - 1, p, p + 1,
                    rigidity.warp * (mapped ? double{std::min(share(p - 1).x, share(p).x)}
                                            : bending_share(cells[0], cells[1], cells[2], cells[3])),
                    dx, dy);
            if (row > 0 && row + 1 < grid.rows())
                add(p - down, p, p + down,
                    rigidity.weft * (mapped ? double{std::min(share(p - down).y, share(p).y)}
                                            : bending_share(cells[0], cells[2], cells[1], cells[3])),
                    dy, dx);
            if (cells[3])
                bending.push_back({{p, p + 1, p + down, p + down + 1},
                                   {1, -1, -1, 1},
                                   2 * rigidity.twist * grid.cell_stiffness(i, j) / (dx * dy)});
        }
}

bool SpringNetwork::held(std::uint32_t particle, double time) const {
    if (mass[particle] == 0) return true;
    const std::int32_t pin = pin_of[particle];
    if (pin < 0) return false;
    const std::optional<double>& release = pins[static_cast<std::size_t>(pin)].release;
    return !release || *release > time;
}

bool SpringNetwork::has_moving_pins() const {
    return std::any_of(pins.begin(), pins.end(), [](const NetworkPin& pin) { return !pin.path.keys.empty(); });
}

Vec3 SpringNetwork::pinned_position(std::uint32_t particle, double time) const {
    if (pin_of[particle] < 0 || mass[particle] == 0) return rest_position[particle];
    const NetworkPin& pin = pins[static_cast<std::size_t>(pin_of[particle])];
    if (pin.path.keys.empty()) return rest_position[particle];
    return transformed(motion_at(pin.path, time), pin.pivot, rest_position[particle]);
}

Vec3 SpringNetwork::pinned_velocity(std::uint32_t particle, double time) const {
    // The backward difference is exact for the cubics that paths are made of: a particle released at a key leaves with
    // the velocity it had before, and the curvature jumps there.
    const double step = 1e-5, weight[4] = {11, -18, 9, -2};
    Vec3 velocity{};
    for (int n = 0; n < 4; ++n) {
        const Vec3 at = pinned_position(particle, time - n * step);
        for (std::size_t k = 0; k < 3; ++k) velocity[k] += weight[n] * at[k] / (6 * step);
    }
    return velocity;
}

std::vector<double> SpringNetwork::release_times() const {
    std::vector<double> times;
    for (const NetworkPin& pin : pins)
        if (pin.release && *pin.release > 0) times.push_back(*pin.release);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

NetworkState SpringNetwork::start() const {
    NetworkState state{rest_position, start_velocities};
    if (start_velocities.empty()) state.velocity.assign(particle_count(), start_velocity);
    for (std::uint32_t p = 0; p < particle_count(); ++p) {
        if (!held(p, 0)) continue;
        state.position[p] = pinned_position(p, 0);
        state.velocity[p] = pinned_velocity(p, 0);
    }
    return state;
}

double SpringNetwork::highest_frequency_bound() const {
    std::vector<double> row_sum(particle_count(), 0.0);
    for (const NetworkSpring& spring : springs)
        for (const std::uint32_t p : {spring.first, spring.second}) row_sum[p] += 2 * spring.stiffness;
    for (const BendingElement& element : bending) {
        double sum = 0;
        for (const double c : element.coefficient) sum += std::abs(c);
        for (std::size_t k = 0; k < 4; ++k)
            row_sum[element.particle[k]] += element.stiffness * std::abs(element.coefficient[k]) * sum;
    }
    double highest = 0;
    for (std::size_t p = 0; p < mass.size(); ++p)
        if (mass[p] > 0) highest = std::max(highest, row_sum[p] / mass[p]);
    return std::sqrt(highest);
}

namespace {

void add(StableHash& hash, const Vec3& v) {
    for (const double c : v) hash.add(c);
}

void add(StableHash& hash, const NetworkPin& pin) {
    hash.add(std::uint64_t{pin.path.keys.size()});
    for (const MotionKey& key : pin.path.keys) {
        hash.add(key.time);
        add(hash, key.translate);
        add(hash, key.rotate);
    }
    add(hash, pin.pivot);
    hash.add(std::uint64_t{pin.release.has_value()});
    hash.add(pin.release.value_or(0.0));
}

/// A vector that stays adds nothing, so that the fingerprint of its network is what it was before there were keys.
void add(StableHash& hash, const std::vector<VectorKey>& keys) {
    for (const VectorKey& key : keys) {
        hash.add(key.time);
        add(hash, key.value);
    }
}

void add(StableHash& hash, const NetworkLoad& load) {
    for (const double each : load.share) hash.add(each);
    for (const double each : load.factor) hash.add(each);
    add(hash, load.load.force);
    add(hash, load.load.force_keys);
    hash.add(load.load.pressure.value_or(0));
    for (const NumberKey& key : load.load.pressure_keys)
        for (const double each : {key.time, key.value}) hash.add(each);
}

void add(StableHash& hash, const NetworkGas& gas) {
    for (const auto& face : gas.faces)
        for (const std::uint32_t p : face) hash.add(std::uint64_t{p});
    hash.add(gas.gas.volume.value_or(0));
    hash.add(gas.gas.ambient);
    for (const NumberKey& key : gas.gas.volume_keys)
        for (const double each : {key.time, key.value}) hash.add(each);
}

void add(StableHash& hash, const Wind& wind) {
    add(hash, wind.velocity);
    for (const double value : {wind.gust.amplitude, wind.gust.period, wind.air_density, wind.drag, wind.lift})
        hash.add(value);
    hash.add(std::uint64_t{wind.gust.seed});
    add(hash, wind.keys);
}

}  // namespace

std::uint64_t SpringNetwork::fingerprint() const {
    StableHash hash;
    for (const std::size_t count : {mass.size(), pins.size(), springs.size(), bending.size(), quarters.size()})
        hash.add(std::uint64_t{count});
    for (const double m : mass) hash.add(m);
    for (const Vec3& x : rest_position) add(hash, x);
    for (const std::int32_t pin : pin_of) hash.add(static_cast<std::uint64_t>(pin));
    for (const NetworkPin& pin : pins) add(hash, pin);
    for (const NetworkSpring& spring : springs) {
        hash.add(std::uint64_t{spring.first} << 32 | spring.second);
        hash.add(spring.stiffness);
        hash.add(spring.rest_length);
        hash.add(static_cast<std::uint64_t>(spring.family));
        hash.add(spring.compression);
    }
    for (const BendingElement& element : bending) {
        for (const std::uint32_t p : element.particle) hash.add(std::uint64_t{p});
        for (const double c : element.coefficient) hash.add(c);
        hash.add(element.stiffness);
    }
    for (const auto& quarter : quarters)
        for (const std::uint32_t p : quarter) hash.add(std::uint64_t{p});
    add(hash, start_velocity);
    for (const Vec3& velocity : start_velocities) add(hash, velocity);
    add(hash, gravity);
    add(hash, gravity_keys);
    hash.add(damping);
    add(hash, wind);
    // Without any of these the fingerprint is as before there were any.
    for (const NetworkLoad& load : loads) add(hash, load);
    for (const NetworkGas& each : gas) add(hash, each);
    return hash.value();
}

}  // namespace drape
