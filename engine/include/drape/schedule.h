// Ways to run the same passes on a device, all but `cyclic` to the same bits.
#pragma once

#include "drape/scene.h"

namespace drape {

enum class Schedule {
    automatic,  ///< chosen by the device
    images,     ///< passes load and store the state's images
    buffers,    ///< they store through buffers of the same memory, which a CPU does sooner
    streams,    ///< likewise; down the rows stream the springs of a relaxation iteration, the twist of all cells, and
                ///< explicit micro-steps, several at once where nothing is between them
    tiles,      ///< images; likewise in tiles of shared memory
    cyclic,     ///< images; an invocation per particle solves lines by cyclic reduction: other rounding
};
inline constexpr Spelling<Schedule> schedule_spellings[] = {
    {"auto", Schedule::automatic},  {"images", Schedule::images}, {"buffers", Schedule::buffers},
    {"streams", Schedule::streams}, {"tiles", Schedule::tiles},   {"cyclic", Schedule::cyclic}};

}  // namespace drape
