// How far apart two runs of a cloth are, from the records that the device's comparison leaves, and the disturbance with
// which the disturbed run begins.
#pragma once

#include <cstdint>
#include <span>

#include "cloth/cloth_model.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Returns the number of workgroups in the comparison; each leaves a record.
std::uint32_t difference_count(const Grid& grid);
/// Returns the root mean square, weighted by mass, of the distance between two runs' particles, m.
double difference_of(std::span<const glsl::DifferenceRecord> partials);

/// Returns that of a cloth, or the distance of the body that is farthest from where the other run has it, whichever is
/// larger, m. `squares`: m^2, of the bodies.
double difference_with_bodies(double of_cloth, std::span<const float> squares);

/// Returns the largest displacement, m, of the disturbed run's particles along each axis.
float disturbance(const ClothModel& cloth);

}  // namespace drape
