// What the library throws for reasons that its caller may act on. Anything else is a defect or a lack of memory.
#pragma once

#include <stdexcept>

namespace drape {

class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// No usable device, a failing Vulkan call, over the memory budget.
class DeviceError : public Error {
    using Error::Error;
};

/// The simulation is no longer finite: names the frame, the cloth and the particle.
class Diverged : public Error {
    using Error::Error;
};

/// A frame misses the tolerance of its scene, or method `auto` gave up on one: names the frame and what it misses.
class ToleranceMissed : public Error {
    using Error::Error;
};

}  // namespace drape
