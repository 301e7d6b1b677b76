// A closed loop judges a frame by its errors over the limits that the scene sets.
#pragma once

#include <span>
#include <vector>

#include "cloth/simulation_model.h"
#include "control/substep_control.h"
#include "drape/statistics.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Returns the frames of a probe: a tenth of a second's. Springs ring much faster, so two runs of that time differ by
/// how the cloth moves.
std::uint32_t probe_length(const SimulationModel& model);

/// Returns the estimated error of the motion, m per second of simulated time, from how far (`difference`, m) the end of
/// `frame_count` frames is from that of a run with half their substeps.
double motion_error(const SimulationModel& model, double difference, std::uint32_t frame_count);
/// Returns the error of the motion that the scene allows, m/s.
double motion_limit(const SimulationModel& model, std::size_t cloth);

/// Returns the worst cloth's stretch error over its limits; infinite where something is not finite.
double stretch_judgement(const SimulationModel& model, const std::vector<ClothStatistics>& cloths);

/// Returns how far (m) truncation may hold a particle back in a substep: half of the least distance of two particles.
/// The springs about it are then stretched or pressed by half, of which no fabric knows (control/watch.h).
double lag_limit(const SimulationModel& model);
/// Returns how far it did in a frame over that. More substeps mostly lessen it, since motions become shorter.
double lag_judgement(const SimulationModel& model, const glsl::SelfRecord& record);

/// Returns how many frames from `frame` on a probe may have, within its length and the scene: a frame whose cuts act on
/// the next one, or in which something is let go of, begins another.
std::uint32_t probe_room(const SimulationModel& model, std::uint32_t frame);

/// Returns whether a pin lets go in the frame, which is known ahead.
bool releases(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
