#include "cloth/cloth_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/vectors.h"
#include "cloth/forces.h"
#include "cloth/frame_inputs.h"
#include "cloth/texels.h"
#include "world/weather.h"

namespace drape {

namespace {

StrainStatistics strain_statistics(std::uint32_t count, double square_sum, double largest, double minus_smallest) {
    if (count == 0) return {};
    return {count, std::sqrt(square_sum / count), largest, -minus_smallest};
}

std::optional<std::uint32_t> particle_of(glsl::uint place) {
    return place == UINT32_MAX ? std::nullopt : std::optional<std::uint32_t>(place);
}

Vec3 in_double(const glsl::vec4& sums) { return {double{sums.x}, double{sums.y}, double{sums.z}}; }

/// Returns the point that the angular momentum is about, m.
Vec3 turning_point(const ClothModel& cloth, const Vec3& center, double time) {
    if (!cloth.turn || !cloth.turn->turns_held() || time >= cloth.turn->until) return center;
    const glsl::ivec2 about = cloth.turn->about;
    return in_double(
        cloth.position[cloth.grid.particle(static_cast<std::uint32_t>(about.x), static_cast<std::uint32_t>(about.y))]);
}

void set_momenta(const ClothModel& cloth, const glsl::StatisticsRecord& record, double time,
                 ClothStatistics& statistics) {
    const double unit = cloth.inner_mass / cloth.substep_length;
    const Vec3 arm =
        minus(turning_point(cloth, statistics.center_of_mass, time), in_double(statistics_reference(cloth)));
    statistics.momentum = times(unit, in_double(record.momentum));
    statistics.angular_momentum = times(unit, minus(in_double(record.spin), cross(arm, in_double(record.mean))));
    const glsl::vec4& errors = record.errors;
    statistics.angular_error = times(unit, Vec3{errors.y + 0.0, errors.z + 0.0, errors.w + 0.0});
}

}  // namespace

glsl::StatisticsPush statistics_push(const SimulationModel& model, const ClothModel& cloth) {
    glsl::StatisticsPush push{};
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
        const double stiffness = cloth.scheme.used_stiffness[direction];
        if (stiffness == 0) continue;
        component(push.rest_length, direction) = static_cast<float>(cloth.stiffness_constant.rest_length[direction]);
        component(push.half_stiffness, direction) = cloth.rigid ? 0.0f : static_cast<float>(0.5 * stiffness);
    }
    if (cloth.bend > 0) {
        const StiffnessConstants& constant = cloth.stiffness_constant;
        const double bend = 0.5 * cloth.scheme.used_bend / cloth.bend,
                     twist = 0.5 * cloth.scheme.used_twist / cloth.bend;
        push.half_bend = {static_cast<float>(bend * constant.bend[0]), static_cast<float>(bend * constant.bend[1]),
                          static_cast<float>(twist * constant.twist), 0};
    }
    push.collider_first = first_collider(model, cloth, model.scene.solver.substeps - 1);
    push.grid = cloth.grid.size();
    push.compression = cloth.compression;
    return push;
}

glsl::vec4 statistics_reference(const ClothModel& cloth) {
    // Sums relative to the cloth's middle keep their digits far from the origin.
    const glsl::vec4 first = cloth.position.front(), last = cloth.position.back();
    return {0.5f * (first.x + last.x), 0.5f * (first.y + last.y), 0.5f * (first.z + last.z), cloth.collision.contact.x};
}

std::vector<float> mass_shares(const ClothModel& cloth) {
    std::vector<float> shares;
    shares.reserve(cloth.free_weight.size());
    for (std::size_t i = 0; i < cloth.free_weight.size(); ++i) {
        const auto place = static_cast<std::uint32_t>(i), columns = cloth.grid.columns();
        // The weight of a sewn particle is that of all that are sewn there.
        const float weight = cloth.sewn.empty() ? cloth.free_weight[i]
                                                : cloth.grid.relative_inverse_mass(place % columns, place / columns);
        shares.push_back(weight > 0 ? 1.0f / weight : 0.0f);
    }
    return shares;
}

ClothStatistics cloth_statistics(const SimulationModel& model, const ClothModel& cloth,
                                 const glsl::StatisticsRecord& record, std::uint32_t frame,
                                 std::span<const std::byte> impulses) {
    const double h = cloth.substep_length;
    const glsl::vec4 reference = statistics_reference(cloth);
    ClothStatistics statistics;
    // Adding +0 turns the -0 of an empty sum into 0.
    statistics.stretch = strain_statistics(record.counts.z, record.squares.x + 0.0, record.strains.x, record.strains.z);
    statistics.shear = strain_statistics(record.counts.w, record.squares.y + 0.0, record.strains.y, record.strains.w);
    if (frame > 0 && record.counts.z > 0) {
        statistics.most_stretched = particle_of(record.places.w);
        statistics.stretch_error_rms = std::sqrt((record.errors.x + 0.0) / record.counts.z);
        statistics.stretch_error_max = record.extents.w;
    }
    statistics.elastic_energy = record.squares.z + 0.0;
    statistics.kinetic_energy = 0.5 * cloth.inner_mass * (record.squares.w + 0.0) / (h * h);
    const double share = record.moments.w + 0.0;
    statistics.mass = cloth.inner_mass * share;
    const double moments[3] = {record.moments.x, record.moments.y, record.moments.z};
    const double start[3] = {reference.x, reference.y, reference.z};
    const Vec3 gravity = gravity_at(model.scene, frame / model.scene.time.fps);
    for (std::size_t k = 0; k < 3; ++k) {
        statistics.center_of_mass[k] = start[k] + (share > 0 ? moments[k] / share : 0.0);
        statistics.potential_energy -= statistics.mass * gravity[k] * statistics.center_of_mass[k];
    }
    set_momenta(cloth, record, frame / model.scene.time.fps, statistics);
    if (model.scene.forces && !impulses.empty())
        statistics.forces = cloth_forces(model, static_cast<std::size_t>(&cloth - model.cloths.data()), impulses,
                                         statistics.mass, frame);
    if (!model.scene.colliders.empty()) {
        statistics.penetration = record.extents.z;
        statistics.deepest = particle_of(record.places.z);
    }
    statistics.farthest = particle_of(record.places.x);
    statistics.fastest = particle_of(record.places.y);
    statistics.largest_distance = std::sqrt(static_cast<double>(record.extents.x));
    statistics.largest_speed = std::sqrt(static_cast<double>(record.extents.y)) / h;
    statistics.non_finite_count = record.counts.x;
    statistics.first_non_finite = record.counts.x > 0 ? record.counts.y : 0;
    return statistics;
}

SeamStatistics seam_statistics(const ClothModel& cloth, std::span<const std::byte> loads) {
    SeamStatistics all;
    for (const Sewn& each : cloth.sewn) {
        glsl::vec4 load;
        std::memcpy(&load, &loads[each.particle * sizeof load], sizeof load);
        if (load.w != 0) ++all.ripped;
        if (load.w != 0 || each.seam == 0) continue;
        all.load = std::max(all.load, std::hypot(double{load.x}, double{load.y}, double{load.z}) / each.seam);
    }
    return all;
}

}  // namespace drape
