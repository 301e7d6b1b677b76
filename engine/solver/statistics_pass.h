// Reduces a cloth's state at the end of a frame to one record on the device; the host reads only that.
#pragma once

#include "cloth/cloth_statistics.h"
#include "solver/cloth_layout.h"

namespace drape {

/// Host output buffer with a glsl::StatisticsRecord per cloth of a state (ClothState::name, count).
std::string statistics_readback_name(const std::string& state);

/// Reads position, displacement, [stiffness, mass share], [colliders]; stage "statistics". Makes the tension that steps
/// of a method do not keep, and hands the number of iterations on where it is not fixed. The sums are trees in a
/// fixed order without atomics, so they repeat bit for bit and equal the twin's (twin/statistics.h).
void add_statistics(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                    const SimulationModel& model);

/// Views what the device leaves of a cloth: its record, the sums of its impulses where the scene wants forces, what its
/// seams bore where some rip, and the state of the gas that it closes in.
struct StatisticsBytes {
    std::span<const std::byte> record, impulses, seams, gas;
};
/// Returns what the slot's last finished frame has left of each cloth.
std::vector<StatisticsBytes> statistics_bytes(const ClothLayout& layout, const graph::ResourcePool& pool,
                                              std::uint32_t slot);
/// Returns the statistics of the cloths of a run.
std::vector<ClothStatistics> statistics_from(std::span<const StatisticsBytes> bytes, std::uint32_t frame,
                                             const SimulationModel& run);
/// Returns each cloth's statistics of the slot's last finished frame, which is `frame`.
std::vector<ClothStatistics> read_statistics(const ClothLayout& layout, const graph::ResourcePool& pool,
                                             std::uint32_t slot, std::uint32_t frame, const SimulationModel& run);

}  // namespace drape
