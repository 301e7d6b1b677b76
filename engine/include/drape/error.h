// The library throws these for reasons that its caller may act on; anything else is a defect or a lack of memory.
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

/// Thrown when no device is usable, a Vulkan call fails or the memory budget is exceeded.
class DeviceError : public Error {
    using Error::Error;
};

/// The reason why a frame is no result.
struct FrameFailure {
    enum class Kind { not_finite, implausible, tolerance };
    Kind kind;
    std::string reason;  ///< one sentence that says all of the rest
    std::uint32_t frame = 0;
    std::string criterion;                                   ///< the quantity that was looked at, such as "speed, m/s"
    double value = 0, bound = 0;                             ///< its value, and the most it may be
    std::string cloth{};                                     ///< its name; empty: no single cloth is concerned
    std::optional<std::array<std::uint32_t, 2>> particle{};  ///< column, row; nothing: no single particle is concerned
};

/// Thrown when the simulation cannot go on, or not as promised.
class FrameError : public Error {
  public:
    using Error::Error;
    /// `text` says the failure's reason at least.
    FrameError(const std::string& text, std::optional<FrameFailure> failure)
        : Error(text), failure_(std::move(failure)) {}
    const std::optional<FrameFailure>& failure() const { return failure_; }

  private:
    std::optional<FrameFailure> failure_;
};

/// Thrown when the simulation is no longer finite or plausible; names the frame, the cloth and perhaps the particle.
class Diverged : public FrameError {
    using FrameError::FrameError;
};

/// Thrown when a frame misses its scene's tolerance or method `auto` gave up on it; names frame and miss.
class ToleranceMissed : public FrameError {
    using FrameError::FrameError;
};

}  // namespace drape
