// What the library throws for reasons that its caller may act on. Anything else is a defect or a lack of memory.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace drape {

class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// No usable device, a failing Vulkan call, over the memory budget.
class DeviceError : public Error {
    using Error::Error;
};

/// Why a frame is no result.
struct FrameFailure {
    enum class Kind { not_finite, implausible, tolerance };
    Kind kind;
    std::string reason;  ///< one sentence, which says all of the rest
    std::uint32_t frame = 0;
    std::string criterion;                                   ///< what was looked at, such as "speed, m/s"
    double value = 0, bound = 0;                             ///< what it was, and the most it may be
    std::string cloth{};                                     ///< its name; empty: of no single one
    std::optional<std::array<std::uint32_t, 2>> particle{};  ///< column, row; nothing: of no single one
};

/// The simulation cannot go on, or not as promised.
class FrameError : public Error {
  public:
    using Error::Error;
    /// `text`: what is said of it, the failure's reason at least.
    FrameError(const std::string& text, std::optional<FrameFailure> failure)
        : Error(text), failure_(std::move(failure)) {}
    const std::optional<FrameFailure>& failure() const { return failure_; }

  private:
    std::optional<FrameFailure> failure_;
};

/// The simulation is no longer finite, or not plausible: names the frame, the cloth and, where it is one, the particle.
class Diverged : public FrameError {
    using FrameError::FrameError;
};

/// A frame misses the tolerance of its scene, or method `auto` gave up on one: names the frame and what it misses.
class ToleranceMissed : public FrameError {
    using FrameError::FrameError;
};

}  // namespace drape
