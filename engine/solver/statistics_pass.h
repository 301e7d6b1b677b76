// Reduces a cloth's state at the end of a frame to one record on the device; the host reads only that.
#pragma once

#include "cloth/cloth_statistics.h"
#include "solver/pass_kit.h"

namespace drape {

/// Host output buffer with a glsl::StatisticsRecord per cloth of a state (ClothState::name, count).
std::string statistics_readback_name(const std::string& state);

/// Reads position, displacement, [stiffness, mass share], [colliders]; stage "statistics". The sums are trees in a
/// fixed order without atomics, so they repeat bit for bit and equal the twin's (twin/statistics.h).
void add_statistics(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                    const SimulationModel& model);

}  // namespace drape
