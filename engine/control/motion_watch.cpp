#include "control/motion_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/motion_error.h"

namespace drape {

bool MotionWatch::Parting::stands_on_a_point() const {
    constexpr double far = 10;
    return parted > far * error;
}

void MotionWatch::look(std::uint32_t frame, const FrameEffort& effort) {
    if (effort.sensitive && !parting_) parting_ = {frame, effort.parted, effort.position_error};
    if (const double times = effort.motion_error / effort.motion_allowed; times > 1) {
        ++hasty_.frames;
        if (times > hasty_.times) hasty_.worst = frame, hasty_.times = times;
    }
    if (!std::isfinite(effort.position_error)) return;
    const double excused = effort.sensitive ? std::min(effort.parted, effort.position_error) : 0;
    const Position now{frame, effort.position_error, excused, effort.position_allowed};
    if (now.share() > 1) ++over_;
    if (!worst_ || now.share() > worst_->share()) worst_ = now;
}

std::vector<std::string> MotionWatch::warnings() const {
    std::vector<std::string> all;
    if (!promises_) return all;
    if (over_ > 0) {
        const std::string excuse =
            worst_->excused > 0
                ? fmt::format(", beside the {:.2g} mm by which equally exact runs had parted", 1000 * worst_->excused)
                : "";
        all.push_back(fmt::format(
            "at frame {} positions are about {:.2g} mm from the exact motion (by an estimate that is right within a "
            "factor of {}), where solver.tolerance_motion allows {:.2g} mm{}; {} frames are beyond it; a smaller one "
            "takes more substeps",
            worst_->frame, 1000 * worst_->error, motion_error_confidence, 1000 * worst_->allowed, excuse, over_));
    }
    if (hasty_.frames > 0)
        all.push_back(fmt::format(
            "{} frames were kept in which the motion's error grew faster than solver.tolerance_motion allows, since "
            "more substeps did not lessen it, or positions were as far off before: {:.2g} times as fast at frame {}, "
            "the worst",
            hasty_.frames, hasty_.times, hasty_.worst));
    if (parting_ && parting_->stands_on_a_point())
        all.push_back(fmt::format(
            "at frame {} the run stands on a point: a run that was disturbed by a millionth of the cloth's size had "
            "left it by {:.2g} mm, where its own error is {:.2g} mm; cloth goes one way or another there, and a little "
            "placement.jitter or wind tells the run which",
            parting_->frame, 1000 * parting_->parted, 1000 * parting_->error));
    return all;
}

std::optional<std::string> MotionWatch::note() const {
    if (!parting_ || parting_->stands_on_a_point()) return std::nullopt;
    return fmt::format(
        "the motion is sensitive from frame {} on: runs that are equally exact had parted by {:.2g} mm there, of the "
        "{:.2g} mm that are its error by the estimate, as where cloth crumples; stretch and contact keep their limits",
        parting_->frame, 1000 * parting_->parted, 1000 * parting_->error);
}

}  // namespace drape
