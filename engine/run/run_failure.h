// Why a run ended before its last frame, where a new run would end at the same place, or which frames are no result.
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

/// Returns the failure of a frame, whose message has its reason and `consequence`.
RunFailure frame_run_failure(const FrameError& error, bool of_tolerance, const std::string& consequence);
/// Returns the failure that is reported at the end of a run that went on after it.
RunFailure kept_failure(const FrameFailure& failure);
/// Returns the failure for an exception; `consequence` is added to the message about a frame that is no result.
RunFailure failure_of(const std::exception_ptr& thrown, const std::string& consequence);

}  // namespace drape
