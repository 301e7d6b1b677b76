// The device (solver/statistics_pass.h) and the twin (twin/statistics.h) reduce a cloth's state to a record. These
// functions turn the record's numbers into ones with units.
#pragma once

#include <span>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"
#include "shared/statistics_types.h"

namespace drape {

/// Returns the constants for the reduction of this cloth's state; the colliders are those of the frame's last substep.
glsl::StatisticsPush statistics_push(const SimulationModel& model, const ClothModel& cloth);

/// Returns in xyz the point that positions are summed relative to, m, in w the thickness, m.
glsl::vec4 statistics_reference(const ClothModel& cloth);

/// Returns the mass per particle, 1 = an inner particle's: the contents of the mass image of a masked cloth.
std::vector<float> mass_shares(const ClothModel& cloth);

/// Returns the statistics with units; the potential energy uses the frame's gravity. Frame 0 is given by the scene: no
/// solver has applied a force, so it has no stretch error. `impulses`: the cloth's sums of the frame, where the scene
/// wants forces.
ClothStatistics cloth_statistics(const SimulationModel& model, const ClothModel& cloth,
                                 const glsl::StatisticsRecord& record, std::uint32_t frame = 1,
                                 std::span<const std::byte> impulses = {});

/// Returns what seams that rip bear at a cloth, from Field::seam_loads as a frame has left it.
SeamStatistics seam_statistics(const ClothModel& cloth, std::span<const std::byte> loads);

}  // namespace drape
