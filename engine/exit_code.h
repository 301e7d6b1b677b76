// The documented exit codes of the command line.
#pragma once

namespace drape {

enum class ExitCode : int {
    ok = 0,
    io = 1,             ///< a file or folder could not be read or written
    usage = 2,          ///< the command line is wrong
    scene = 3,          ///< the scene is wrong
    device = 4,         ///< no usable device, a failing Vulkan call, over the memory budget
    diverged = 5,       ///< the simulation is no longer finite
    validation = 6,     ///< a validation message was reported
    comparison = 7,     ///< a comparison is over its limit
    tolerance = 8,      ///< the promised accuracy cannot be reached
    interrupted = 130,  ///< SIGINT
    terminated = 143,   ///< SIGTERM
};

}  // namespace drape
