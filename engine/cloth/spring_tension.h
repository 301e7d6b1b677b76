// What a frame tells of each spring and each particle (SceneDescription::force_fields). Pure.
#pragma once

#include <span>
#include <vector>

#include "cloth/cut_topology.h"
#include "cloth/simulation_model.h"

namespace drape {

/// Returns whether the device keeps the tension with which a direction's springs were solved: the multipliers of
/// `line`, of which all directions have some, and of `relax`. The springs of explicit steps, and diagonals of which
/// `relax` keeps none, pull by their law from where they are.
bool keeps_tension(const ClothModel& cloth, std::size_t direction);

/// Returns what each spring bears at a frame's end, N, as FinishedFrame::tensions. `positions`: x y z w per particle;
/// `kept`: by direction the tensions that the device keeps, m (Field::tension_row and so on), as a number per particle;
/// empty: none, and the springs' law tells.
std::vector<float> spring_tensions(const SimulationModel& model, std::size_t cloth, const CutTopology& topology,
                                   std::uint32_t frame, std::span<const float> positions,
                                   const PerDirection<std::span<const float>>& kept);

/// Returns the mean force of contact on each particle in a frame, N, as FinishedFrame::contact_forces.
/// `impulses`: of Field::contact_impulses; empty: nothing can touch it.
std::vector<float> contact_forces(const SimulationModel& model, std::size_t cloth, std::span<const float> impulses);

/// Returns by particle the springs that are there, as Simulation::spring_bits.
std::vector<std::uint8_t> spring_bits(const CutTopology& topology);

}  // namespace drape
