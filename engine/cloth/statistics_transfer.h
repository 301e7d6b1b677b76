// Stores the statistics of a frame in a saved state.
#pragma once

#include "drape/statistics.h"

namespace drape {

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
}

}  // namespace drape
