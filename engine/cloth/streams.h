// A frame's steps where passes stream down the rows (shaders/explicit_stream.comp, shaders/sweep.comp,
// shaders/twist_sweep.comp) or take tile by tile (shaders/explicit_tile.comp, shaders/sweep_tile.comp): the same work,
// to the same bits, in fewer steps. Pure.
#pragma once

#include <functional>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// How many micro-steps of a cloth at least and at most become one.
struct FlightSize {
    std::uint32_t least, most;
};

/// Explicit micro-steps of a cloth between which nothing else happens to it become one. Not those that
/// bend, which need neighbours farther off; not a frame's last, so that the spare images hold the displacement of the
/// substep before it.
std::vector<Step> steps_in_flight(const std::vector<Step>& steps,
                                  const std::function<FlightSize(std::size_t cloth)>& size);

/// All springs of a relaxation iteration become one step, where no tension is carried on and the device does not
/// decide whether they are relaxed. What takes an odd number of those in a substep begins with a prediction that turns,
/// so that every substep leaves the displacement where it found it.
std::vector<Step> steps_in_sweeps(const SimulationModel& model, const std::vector<Step>& steps);

/// The twist of all colours of a cloth's cells becomes one step, likewise.
std::vector<Step> twists_in_sweeps(const std::vector<Step>& steps);

/// Whether a sweep relaxes springs of that direction (engine/cloth/directions.h).
bool has_direction(const glsl::SweepPush& push, int direction);

/// The steps of a frame (schedule.h), all done.
std::vector<Step> streamed_steps(const SimulationModel& model);

/// How many particles a tile shares with the next one at either side, given the halo that it needs: none where one tile
/// holds the whole cloth.
std::uint32_t tile_halo_of(const Grid& grid, int halo);

/// Invocations along a side of a cloth of so many particles, in tiles.
std::uint32_t tile_invocations(std::uint32_t particles, std::uint32_t halo);

/// The steps of a frame, explicit micro-steps as many at once as tiles take, springs in sweeps.
std::vector<Step> tiled_steps(const SimulationModel& model);

}  // namespace drape
