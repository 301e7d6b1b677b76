// The device (solver/statistics_pass.h) and the twin (reference/statistics.h) reduce a cloth's state to a record; here
// its numbers get their units. Pure.
#pragma once

#include "cloth/simulation_model.h"
#include "drape/statistics.h"
#include "shared/statistics_types.h"

namespace drape {

/// What a state of this cloth is reduced with; colliders are those of the frame's last substep.
glsl::StatisticsPush statistics_push(const SimulationModel& model, const ClothModel& cloth);

/// xyz: positions are summed relative to this point, m; w: thickness, m.
glsl::vec4 statistics_reference(const ClothModel& cloth);

/// Mass per particle, 1 = an inner particle's: the contents of the mass image of a masked cloth.
std::vector<float> mass_shares(const ClothModel& cloth);

ClothStatistics cloth_statistics(const SimulationModel& model, const ClothModel& cloth,
                                 const glsl::StatisticsRecord& record);

}  // namespace drape
