// A run that ended before its end would end there again, or has frames that are no result.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "drape/error.h"

namespace drape {

inline constexpr const char* output_failed = "output failed";

struct RunFailure {
    std::string status, reason;
    std::optional<FrameFailure> frame;
    std::exception_ptr error;
};

/// Returns the failure of a frame, to be told as its reason and `consequence`.
RunFailure frame_run_failure(const FrameError& error, bool of_tolerance, const std::string& consequence);
/// Returns what is said at the end of a run that went on.
RunFailure kept_failure(const FrameFailure& failure);
/// Returns the failure of what was thrown; `consequence` is told of a frame that is no result.
RunFailure failure_of(const std::exception_ptr& thrown, const std::string& consequence);

}  // namespace drape
