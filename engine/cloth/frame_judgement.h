// What a closed loop judges a frame by: its errors over the limits that the scene sets. Pure.
#pragma once

#include <span>
#include <vector>

#include "cloth/simulation_model.h"
#include "cloth/substep_control.h"
#include "drape/statistics.h"
#include "shared/closed_loop_types.h"

namespace drape {

/// Frames of a probe: a tenth of a second's. Springs ring much faster, so what two runs of that time differ by is how
/// the cloth moves.
std::uint32_t probe_length(const SimulationModel& model);

/// Workgroups of the comparison, each of which leaves a record.
std::uint32_t difference_count(const Grid& grid);
/// Root mean square over the cloth's mass of how far two runs are apart, m.
double difference_of(std::span<const glsl::DifferenceRecord> partials);

/// Estimated error of the motion, m per second of simulated time, from how far (`difference`, m) the end of
/// `frame_count` frames is from that of a run with half their substeps.
double motion_error(const SimulationModel& model, double difference, std::uint32_t frame_count);
/// That the scene allows, m/s.
double motion_limit(const SimulationModel& model, std::size_t cloth);

/// The worst cloth's stretch error over its limits; infinite where something is not finite.
double stretch_judgement(const SimulationModel& model, const std::vector<ClothStatistics>& cloths);

/// Frames from `frame` on that a probe may have, no more than its length: a frame whose cuts act on the next one, or in
/// which something is let go of, begins another. Not beyond the scene's last.
std::uint32_t probe_room(const SimulationModel& model, std::uint32_t frame);

/// Whether a pin lets go in the frame: known ahead.
bool releases(const SimulationModel& model, std::uint32_t frame);

}  // namespace drape
