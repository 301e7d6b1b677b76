#include "cloth/gas.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "base/vectors.h"
#include "cloth/frame_inputs.h"
#include "world/gas.h"
#include "world/seams.h"

namespace drape {

namespace {

double mass_of(const ClothModel& cloth, std::size_t particle) {
    const double weight = double{cloth.free_weight[particle]};
    return weight > 0 ? cloth.inner_mass / weight : 0;
}

/// Returns the shares of particles that are sewn to none.
std::vector<glsl::vec2> own_shares(const ClothModel& cloth, double counted) {
    std::vector<glsl::vec2> shares;
    for (std::size_t i = 0; i < cloth.free_weight.size(); ++i) {
        const double mass = mass_of(cloth, i);
        shares.push_back({1, static_cast<float>(mass > 0 ? counted / mass : 0)});
    }
    return shares;
}

/// Sets the shares of sewn particles: those of a gas share the area of a place by their masses. A place of mass M moves
/// by h^2 A/M for each pascal, whatever is sewn there, and makes the volume grow by A times that.
void share_places(const SceneDescription& scene, const std::map<std::size_t, double>& counted,
                  std::vector<ClothModel>& cloths) {
    const Sewing sewing = sewing_of(scene);
    const std::vector<double> masses = sewn_masses(scene);
    for (std::size_t k = 0; k < sewing.stations.size(); ++k) {
        double sum = 0;
        for (const SewnMember& member : sewing.stations[k].group)
            if (counted.contains(member.cloth)) sum += mass_of(cloths[member.cloth], member.particle);
        for (const SewnMember& member : sewing.stations[k].group) {
            if (!counted.contains(member.cloth)) continue;
            const double part = mass_of(cloths[member.cloth], member.particle) / sum;
            cloths[member.cloth].gas->shares[member.particle] = {
                static_cast<float>(part), static_cast<float>(counted.at(member.cloth) * part / masses[k])};
        }
    }
    for (const SewnBetween& each : sewing.between)
        for (const SewnMember& member : each.group)
            if (counted.contains(member.cloth)) cloths[member.cloth].gas->shares[member.particle] = {0, 0};
}

/// Returns the state of a gas at the start, and gives its cloths their half kick. What a stiff gas gives is less by
/// what the cloths yield meanwhile: its pressure in the kick is that of the law with half a substep's growth.
glsl::GasState begin(const SceneDescription& scene, const Gas& gas, std::span<const GasWall> walls,
                     std::vector<ClothModel>& cloths) {
    double volume = 0, yielding = 0, area = 0;
    std::vector<std::vector<Vec3>> areas;
    for (const GasWall& wall : walls) {
        const ClothModel& cloth = cloths[wall.cloth];
        const std::vector<Vec3> at = cloth.start_places();
        volume += wall.sign * volume_behind(scene.cloths[wall.cloth], at);
        areas.push_back(areas_borne(scene.cloths[wall.cloth], at));
        for (std::size_t i = 0; i < at.size(); ++i) {
            Vec3& own = areas.back()[i];
            own = times(wall.sign, own);
            area += length(own);
            const double h = cloth.substep_length, mass = mass_of(cloth, i);
            if (cloth.position[i].w > 0) yielding += h * h / 2 * dot(own, own) / mass;
        }
    }
    const double kick = gas_pressure(gas, 0, volume, yielding);
    for (std::size_t k = 0; k < walls.size(); ++k) {
        for (Vec3& own : areas[k]) own = times(kick, own);
        cloths[walls[k].cloth].kick(areas[k]);
    }
    const double told = closes_nothing_in(volume, area) ? 0 : gas_pressure(gas, 0, volume);
    return {{static_cast<float>(told), static_cast<float>(volume), 0, 0}, {}};
}

}  // namespace

std::uint32_t gas_sum_count(const ClothModel& cloth) {
    const auto count = static_cast<std::uint32_t>(cloth.grid.particle_count());
    return (count + glsl::gas_particles - 1) / glsl::gas_particles;
}

std::size_t add_gas(const SceneDescription& scene, std::vector<ClothModel>& cloths) {
    std::map<std::size_t, double> counted;  // by cloth, the mean of what damping leaves of a force in a substep
    int next = 0;
    for (std::size_t number = 0; number < scene.gas.size(); ++number) {
        const Gas& gas = scene.gas[number];
        const std::vector<GasWall> walls = gas_walls(scene, gas);
        const glsl::GasState start = begin(scene, gas, walls, cloths);
        const int first = next;
        for (const GasWall& wall : walls) {
            ClothModel& cloth = cloths[wall.cloth];
            counted[wall.cloth] = damping_mean(cloth.damping, cloth.substep_length);
            cloth.gas = ClothGas{number,
                                 wall.sign,
                                 first,
                                 0,
                                 next,
                                 static_cast<float>(gas.ambient),
                                 own_shares(cloth, counted[wall.cloth]),
                                 start};
            next += static_cast<int>(gas_sum_count(cloth));
        }
        for (const GasWall& wall : walls) cloths[wall.cloth].gas->count = next - first;
    }
    if (next > 0) share_places(scene, counted, cloths);
    return static_cast<std::size_t>(next);
}

glsl::GasAreaPush gas_area_push(const ClothModel& cloth) {
    return {cloth.grid.size(), cloth.gas ? static_cast<float>(cloth.gas->sign) : 0.0f, 0};
}

glsl::GasSumPush gas_sum_push(const ClothModel& cloth) {
    const auto exists = [](float weight) { return weight > 0; };
    const auto origin = std::ranges::find_if(cloth.free_weight, exists) - cloth.free_weight.begin();
    return {cloth.grid.size(), cloth.gas->own, static_cast<int>(origin)};
}

glsl::GasPush gas_push(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep, int joint,
                       bool ends) {
    const ClothGas& gas = *cloth.gas;
    const double h = cloth.substep_length;
    const std::size_t behind = model.scene.gas.size() - gas.number;
    const std::size_t weather =
        ends ? 0 : first_weather(model, cloth.member, substep) + weather_vectors(model) - behind;
    const auto* const predicts = std::get_if<glsl::PredictPush>(&cloth.scheme.prediction.front().constants);
    return {gas.first,
            gas.count,
            static_cast<int>(weather),
            ends ? 1 : 0,
            {static_cast<float>(h * h), static_cast<float>(h * h * 4 / 9)},
            static_cast<float>(h),
            gas.ambient,
            joint,
            predicts ? predicts->most_wrong : 0,
            0,
            0};
}

GasStatistics gas_statistics(std::span<const std::byte> state) {
    glsl::vec4 now;
    std::memcpy(&now, state.data(), sizeof now);
    return {double{now.x}, double{now.y}};
}

}  // namespace drape
