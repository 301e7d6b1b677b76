// How far two runs of a cloth are apart, from what the device leaves of the comparison; and the disturbance that one of
// them begins with.
#pragma once

#include <cstdint>
#include <span>

#include "cloth/cloth_model.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Returns the workgroups of the comparison, each of which leaves a record.
std::uint32_t difference_count(const Grid& grid);
/// Returns the root mean square over the cloth's mass of how far two runs are apart, m.
double difference_of(std::span<const glsl::DifferenceRecord> partials);

/// Returns how far (m) the disturbed run's particles are displaced along each axis, at most.
float disturbance(const ClothModel& cloth);

}  // namespace drape
