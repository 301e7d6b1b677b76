#include "cloth/motion_error.h"

#include <algorithm>
#include <cmath>

#include "cloth/frame_judgement.h"

namespace drape {

namespace {

/// s, within which an error that is not seen any more falls to 1/e.
constexpr double hold = 1.5;
/// s, the shortest time for which an error is allowed.
constexpr double least_time = 0.5;

}  // namespace

bool compares_at(const SimulationModel& model, std::uint32_t last, bool probes) {
    return probes || last % probe_length(model) == 0;
}

MotionError::MotionError(const SimulationModel& model) : model_(model), held_(model.cloths.size()) {}

/// Few substeps have companions of other ratios than many. What runs are apart by was made with those that there were
/// at the time, the more by the longer substeps.
void MotionError::weigh(std::uint32_t substeps, double passed, double kept) {
    const StepRatios now = step_ratios(model_.companions(substeps), substeps);
    const double made = passed * std::pow(substeps, -usual_order), before = kept * weight_;
    weight_ = before + made;
    const auto mean = [&](double earlier, double one) {
        return weight_ > 0 ? (before * earlier + made * one) / weight_ : one;
    };
    ratios_ = {mean(ratios_.companion, now.companion), mean(ratios_.coarser, now.coarser)};
}

void MotionError::saw(std::uint32_t frame, std::uint32_t substeps, std::span<const double> apart,
                      std::span<const double> further) {
    const double passed = (frame - last_frame_) / model_.scene.time.fps, kept = std::exp(-passed / hold);
    const double time = std::max(frame / model_.scene.time.fps, least_time);
    weigh(substeps, passed, kept);
    last_frame_ = frame;
    error_ = share_ = 0;
    for (std::size_t cloth = 0; cloth < apart.size(); ++cloth) {
        const double error = richardson_error(ratios_, apart[cloth], further.empty() ? 0 : further[cloth]);
        held_[cloth] = std::max(error, kept * held_[cloth]);
        error_ = std::max(error_, held_[cloth]);
        share_ = std::max(share_, held_[cloth] / (motion_limit(model_, cloth) * time));
    }
}

double MotionError::at_end() const {
    const TimeSettings& time = model_.scene.time;
    const double now = std::max(last_frame_ / time.fps, least_time), end = (time.frame_count - 1) / time.fps;
    return error_ * std::max(1.0, end / now);
}

}  // namespace drape
