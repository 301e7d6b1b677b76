// A closed loop judges a frame by its errors, each divided by the limit that the scene sets.
#pragma once

#include <span>
#include <vector>

#include "cloth/simulation_model.h"
#include "control/substep_control.h"
#include "drape/statistics.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Returns the number of frames in a probe, a tenth of a second. Springs vibrate much faster, so two runs over this
/// time differ by how the cloth moves.
std::uint32_t probe_length(const SimulationModel& model);

/// Returns the estimated error of the motion, m per second of simulated time, from the distance (`difference`, m)
/// between the positions after `frame_count` frames and those of a run with half the substeps.
double motion_error(const SimulationModel& model, double difference, std::uint32_t frame_count);
/// Returns the error of the motion that the scene allows, m/s.
double motion_limit(const SimulationModel& model, std::size_t cloth);

/// Returns the worst cloth's stretch error divided by its limit; infinite where something is not finite.
double stretch_judgement(const SimulationModel& model, const std::vector<ClothStatistics>& cloths);

/// Returns how far (m) truncation may hold a particle back in a substep: half of the least distance between two
/// particles. It would stretch or compress the springs around the particle by half, which no fabric survives
/// (control/watch.h).
double lag_limit(const SimulationModel& model);
/// Returns how far truncation held a particle back in a frame, divided by `lag_limit`. More substeps mostly reduce it,
/// since motions become shorter.
double lag_judgement(const SimulationModel& model, const glsl::SelfRecord& record);

/// Returns how much angular momentum the method made, and took back, in a frame of the worst cloth, over what would
/// give cloth half its longer side from the axis, in a tenth of a second, the speed that the motion's limit allows.
double turning_judgement(const SimulationModel& model, const std::vector<ClothStatistics>& cloths);

/// Returns how many frames a probe from `frame` on may have, within its usual length and the scene. A probe ends before
/// a frame that begins with a new cut, or in which a pin lets go.
std::uint32_t probe_room(const SimulationModel& model, std::uint32_t frame);

/// Returns whether a pin lets go in the frame, which the scene says in advance.
bool releases(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
