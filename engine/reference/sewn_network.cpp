#include "reference/sewn_network.h"

#include <stdexcept>
#include <utility>

#include "base/vectors.h"
#include "world/gas.h"
#include "world/seams.h"
#include "world/start.h"

namespace drape {

namespace {

/// Gives every particle of every cloth its number: a sewn one that of its leader.
std::vector<std::vector<std::uint32_t>> numbered(const SceneDescription& scene) {
    std::vector<std::vector<std::uint32_t>> numbers;
    std::vector<std::vector<const SewnMember*>> leaders;
    for (const Cloth& cloth : scene.cloths) {
        numbers.emplace_back(std::size_t{cloth.grid[0]} * cloth.grid[1]);
        leaders.emplace_back(numbers.back().size(), nullptr);
    }
    const Sewing sewing = sewing_of(scene);
    if (!sewing.between.empty())
        throw std::invalid_argument("the network of sewn cloths knows no particle that lies between others");
    for (const auto& [group, close, rip] : sewing.stations)
        for (std::size_t k = 1; k < group.size(); ++k) leaders[group[k].cloth][group[k].particle] = group.data();
    std::uint32_t count = 0;
    for (std::size_t cloth = 0; cloth < numbers.size(); ++cloth)
        for (std::size_t i = 0; i < numbers[cloth].size(); ++i) {
            const SewnMember* const leader = leaders[cloth][i];
            numbers[cloth][i] = leader ? numbers[leader->cloth][leader->particle] : count++;
        }
    return numbers;
}

/// Adds the particles of a cloth.
void add_particles(const SpringNetwork& own, const std::vector<std::uint32_t>& at, SpringNetwork& all) {
    for (std::size_t i = 0; i < own.particle_count(); ++i) {
        const std::uint32_t to = at[i];
        if (to == all.mass.size()) {
            all.mass.push_back(0);
            all.rest_position.push_back(own.rest_position[i]);
            all.start_velocities.emplace_back();
            all.pin_of.push_back(-1);
        }
        const Vec3& velocity = own.start_velocities.empty() ? own.start_velocity : own.start_velocities[i];
        const double mass = all.mass[to] + own.mass[i], part = mass > 0 ? own.mass[i] / mass : 1;
        all.start_velocities[to] = plus(times(1 - part, all.start_velocities[to]), times(part, velocity));
        all.mass[to] = mass;
        if (own.pin_of[i] < 0) continue;
        all.pin_of[to] = own.pin_of[i] + static_cast<std::int32_t>(all.pins.size());
        all.rest_position[to] = own.rest_position[i];
    }
    all.pins.insert(all.pins.end(), own.pins.begin(), own.pins.end());
}

/// Adds what acts between a cloth's particles.
void add_elements(const SpringNetwork& own, const std::vector<std::uint32_t>& at, SpringNetwork& all) {
    for (NetworkSpring spring : own.springs) {
        spring.first = at[spring.first], spring.second = at[spring.second];
        all.springs.push_back(spring);
    }
    for (BendingElement element : own.bending) {
        for (std::uint32_t& particle : element.particle) particle = at[particle];
        all.bending.push_back(element);
    }
    for (std::array<std::uint32_t, 3> quarter : own.quarters) {
        for (std::uint32_t& particle : quarter) particle = at[particle];
        all.quarters.push_back(quarter);
    }
}

/// Returns the faces of a gas, as its cloths turn them outwards.
NetworkGas gas_in(const SceneDescription& scene, const Gas& gas,
                  const std::vector<std::vector<std::uint32_t>>& particle) {
    NetworkGas made{gas, {}};
    for (const auto& [cloth, sign] : gas_walls(scene, gas)) {
        const std::vector<std::uint32_t>& at = particle[cloth];
        const std::vector<bool> missing = missing_cells(scene.cloths[cloth]);
        const std::size_t columns = scene.cloths[cloth].grid[0];
        for (std::size_t cell = 0; cell < missing.size(); ++cell) {
            if (missing[cell]) continue;
            const std::size_t k = cell / (columns - 1) * columns + cell % (columns - 1);
            std::array<std::uint32_t, 4> face{at[k], at[k + 1], at[k + columns + 1], at[k + columns]};
            if (sign < 0) std::swap(face[1], face[3]);
            made.faces.push_back(face);
        }
    }
    return made;
}

}  // namespace

SewnNetwork sewn_network(const SceneDescription& scene, const NetworkOptions& options) {
    SewnNetwork sewn{{}, numbered(scene)};
    SpringNetwork& all = sewn.network;
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
        const SpringNetwork own(scene, cloth, options);
        if (!own.loads.empty()) throw std::invalid_argument("the network of sewn cloths knows no loads");
        if (cloth > 0 && own.damping != all.damping)
            throw std::invalid_argument("the network of sewn cloths has one damping");
        all.gravity = own.gravity, all.gravity_keys = own.gravity_keys;
        all.damping = own.damping, all.wind = own.wind;
        add_particles(own, sewn.particle[cloth], all);
        add_elements(own, sewn.particle[cloth], all);
    }
    for (const Gas& gas : scene.gas) all.gas.push_back(gas_in(scene, gas, sewn.particle));
    return sewn;
}

}  // namespace drape
