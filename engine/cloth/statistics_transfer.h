// Stores the statistics of a frame in a saved state.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/byte_stream.h"
#include "drape/statistics.h"

namespace drape {

/// Writes or reads the forces on a cloth.
template <class Archive>
void transfer_forces(Archive& archive, std::vector<ForceOnCloth>& forces) {
    std::vector<std::string> by;
    std::vector<double> numbers, moments;
    for (const ForceOnCloth& each : forces) {
        by.push_back(each.by);
        numbers.insert(numbers.end(), each.force.begin(), each.force.end());
        if (each.moment) moments.insert(moments.end(), each.moment->begin(), each.moment->end());
        if (!each.moment) moments.insert(moments.end(), 3, std::numeric_limits<double>::quiet_NaN());
    }
    archive(by, numbers, moments);
    if (numbers.size() != 3 * by.size() || moments.size() != 3 * by.size()) throw Error("its forces do not fit");
    forces.clear();
    for (std::size_t k = 0; k < by.size(); ++k) {
        ForceOnCloth& each = forces.emplace_back();
        each.by = by[k];
        std::copy_n(&numbers[3 * k], 3, each.force.begin());
        if (!std::isnan(moments[3 * k])) std::copy_n(&moments[3 * k], 3, each.moment.emplace().begin());
    }
}

/// Writes or reads a cloth's statistics, by a ByteWriter or a ByteReader (byte_stream.h).
template <class Archive>
void transfer_statistics(Archive& archive, ClothStatistics& s) {
    for (StrainStatistics* strain : {&s.stretch, &s.shear})
        archive(strain->spring_count, strain->rms, strain->largest, strain->smallest);
    for (std::array<double, 3>* vector : {&s.momentum, &s.angular_momentum, &s.angular_error})
        archive((*vector)[0], (*vector)[1], (*vector)[2]);
    archive(s.stretch_error_rms, s.stretch_error_max, s.kinetic_energy, s.potential_energy, s.elastic_energy, s.mass,
            s.center_of_mass[0], s.center_of_mass[1], s.center_of_mass[2], s.penetration, s.largest_distance,
            s.largest_speed, s.iteration_count, s.non_finite_count, s.first_non_finite, s.farthest, s.fastest,
            s.deepest, s.most_stretched);
    transfer_forces(archive, s.forces);
    std::optional<double> load;
    std::uint32_t ripped = s.seams ? s.seams->ripped : 0;
    if (s.seams) load = s.seams->load;
    archive(load, ripped);
    s.seams = load ? std::optional<SeamStatistics>({*load, ripped}) : std::nullopt;
    std::optional<double> pressure;
    double volume = s.gas ? s.gas->volume : 0;
    if (s.gas) pressure = s.gas->pressure;
    archive(pressure, volume);
    s.gas = pressure ? std::optional<GasStatistics>({*pressure, volume}) : std::nullopt;
}

}  // namespace drape
