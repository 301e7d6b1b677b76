#include "run/run_failure.h"

#include <new>
#include <stdexcept>

#include "base/output_error.h"

namespace drape {

RunFailure frame_run_failure(const FrameError& error, bool of_tolerance, const std::string& consequence) {
    const std::string text = error.what() + consequence;
    return {of_tolerance ? "tolerance missed" : "diverged", error.what(), error.failure(),
            of_tolerance ? std::make_exception_ptr(ToleranceMissed(text, error.failure()))
                         : std::make_exception_ptr(Diverged(text, error.failure()))};
}

RunFailure kept_failure(const FrameFailure& failure) {
    return frame_run_failure(FrameError(failure.reason, failure), failure.kind == FrameFailure::Kind::tolerance,
                             "; it and what came after are kept, as --on-failure keep asks");
}

namespace {

/// Returns the failure for the exception being handled, which was not caused by a frame's numbers.
RunFailure broken_run(const std::exception& error) {
    const char* status = dynamic_cast<const OutputError*>(&error)      ? output_failed
                         : dynamic_cast<const DeviceError*>(&error)    ? "device failed"
                         : dynamic_cast<const std::bad_alloc*>(&error) ? "out of memory"
                                                                       : "internal error";
    return {status, error.what(), std::nullopt, std::current_exception()};
}

}  // namespace

RunFailure failure_of(const std::exception_ptr& thrown, const std::string& consequence) {
    try {
        std::rethrow_exception(thrown);
    } catch (const Diverged& error) {
        return frame_run_failure(error, false, consequence);
    } catch (const ToleranceMissed& error) {
        return frame_run_failure(error, true, consequence);
    } catch (const std::exception& error) {
        return broken_run(error);
    }
}

}  // namespace drape
