// The steps of a frame by kernels that do several plain steps at once or one in another way (drape/kernels.h): the same
// work, to the same bits but by cyclic reduction. Pure.
#pragma once

#include <functional>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// The steps of a frame (frame_steps.h), done by those of the kernels that suit them. Of kernels for the same step the
/// one that is first in `Kernel` is taken.
std::vector<Step> kernel_steps(const SimulationModel& model, const Kernels& kernels);

/// How many explicit steps of a cloth become one, at least and at most.
struct FlightSize {
    std::uint32_t least, most;
};

/// Explicit steps of a cloth between which nothing else happens to it become one of `kernel`. Steps that bend stay
/// alone, since they need neighbours farther off, and a frame's last one does, so that the spare images hold the
/// displacement of the substep before it.
std::vector<Step> explicit_steps_together(const std::vector<Step>& steps, Kernel kernel,
                                          const std::function<FlightSize(std::size_t cloth)>& size);

/// All springs of a relaxation iteration become one step of `kernel`, where the device does not decide whether they are
/// relaxed and tension is carried by the springs of all directions or of none. A substep with an odd number of such
/// steps begins with a prediction that turns, so that every substep leaves the displacement where it found it.
std::vector<Step> springs_together(const SimulationModel& model, Kernel kernel, const std::vector<Step>& steps);

/// The twist of all colours of a cloth's cells becomes one step of `kernel`, and turns as springs do.
std::vector<Step> twists_together(Kernel kernel, const std::vector<Step>& steps);

/// Whether a step of all springs has springs of that direction (cloth/directions.h).
bool has_direction(const glsl::AllSpringsPush& push, int direction);

/// The particles along a side of a tile, and those at every side that are of no use (shared/tile_types.h).
struct Tile {
    std::uint32_t width, halo;
};

/// Returns the tiles in which steps of this kind take a cloth. Where one holds the whole cloth it needs no halo.
Tile tile_of(StepKind kind, const Grid& grid);

/// Invocations along a side of a cloth of so many particles, in tiles.
std::uint32_t tile_invocations(std::uint32_t particles, const Tile& tile);

}  // namespace drape
