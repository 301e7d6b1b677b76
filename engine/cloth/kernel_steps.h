// Replaces steps of a frame by kernels that do several plain steps at once, or do one in another way (drape/kernels.h).
// The results are the same to the bit, except by cyclic reduction. Pure.
#pragma once

#include <functional>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns the steps of a frame (frame_steps.h) as done by those of the kernels that suit them. Among kernels for the
/// same step, the first in `Kernel` is chosen.
std::vector<Step> kernel_steps(const SimulationModel& model, const Kernels& kernels);

/// The smallest and largest number of explicit steps of a cloth that may become one.
struct FlightSize {
    std::uint32_t least, most;
};

/// Explicit steps of a cloth between which nothing else happens to it become one step of `kernel`. Steps that bend stay
/// alone, since they need neighbours farther off. A frame's last step does too, so that the spare images hold the
/// displacement of the substep before it.
std::vector<Step> explicit_steps_together(const std::vector<Step>& steps, Kernel kernel,
                                          const std::function<FlightSize(std::size_t cloth)>& size);

/// All springs of a relaxation iteration become one step of `kernel`, unless the device decides whether they are
/// relaxed, or only some directions carry tension. A substep with an odd number of such steps begins with a prediction
/// that writes the spare image (Step::turns), so that every substep leaves the displacement in the same image.
std::vector<Step> springs_together(const SimulationModel& model, Kernel kernel, const std::vector<Step>& steps);

/// The twist of all colours of a cloth's cells becomes one step of `kernel`, with spare images used as for springs.
std::vector<Step> twists_together(Kernel kernel, const std::vector<Step>& steps);

/// Returns whether a step of all springs includes springs of that direction (cloth/directions.h).
bool has_direction(const glsl::AllSpringsPush& push, int direction);

/// The number of particles along a side of a tile, and the width of its border whose results are not valid
/// (shared/tile_types.h).
struct Tile {
    std::uint32_t width, halo;
};

/// Returns the tile of steps of this kind for a cloth. A tile that holds the whole cloth needs no halo.
Tile tile_of(StepKind kind, const Grid& grid);

/// Returns the number of invocations along a side of a cloth of so many particles, in tiles.
std::uint32_t tile_invocations(std::uint32_t particles, const Tile& tile);

}  // namespace drape
