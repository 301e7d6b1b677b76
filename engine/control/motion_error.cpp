#include "control/motion_error.h"

#include <algorithm>
#include <cmath>

#include "control/frame_judgement.h"

namespace drape {

namespace {

/// s, the shortest time for which an error is allowed.
constexpr double least_time = 0.5;

}  // namespace

bool compares_at(const SimulationModel& model, std::uint32_t last, bool probes) {
    return probes || last % probe_length(model) == 0;
}

MotionError::MotionError(const SimulationModel& model)
    : model_(model), held_(model.cloths.size()), apart_(model.cloths.size()) {}

double MotionError::order() const { return error_order(row_of(model_.scene.solver.method), model_.closed_loop()); }

/// The ratio of the companion's substeps to the run's depends on the number of substeps. The distance between the runs
/// arose with the ratios of the past, and long substeps contributed more to it, so the ratio is a weighted average.
void MotionError::weigh(std::uint32_t substeps, double passed, double kept) {
    const double now = static_cast<double>(substeps) / model_.companion_substeps(substeps);
    const double made = passed * std::pow(substeps, -order()), before = kept * weight_;
    weight_ = before + made;
    ratio_ = weight_ > 0 ? (before * ratio_ + made * now) / weight_ : now;
}

void MotionError::saw(std::uint32_t frame, std::uint32_t substeps, std::span<const double> apart) {
    const double passed = (frame - last_frame_) / model_.scene.time.fps, kept = std::exp(-passed / motion_error_hold);
    const double time = std::max(frame / model_.scene.time.fps, least_time);
    weigh(substeps, passed, kept);
    last_frame_ = frame;
    growth_ = 0;
    for (std::size_t cloth = 0; cloth < apart.size(); ++cloth) {
        const double grown = richardson_error(order(), ratio_, std::max(apart[cloth] - apart_[cloth], 0.0));
        growth_ = std::max(growth_, grown / (motion_limit(model_, cloth) * passed));
        apart_[cloth] = apart[cloth];
        held_[cloth] = std::max(richardson_error(order(), ratio_, apart[cloth]), kept * held_[cloth]);
        const double allowed = motion_limit(model_, cloth) * time;
        if (cloth > 0 && held_[cloth] / allowed <= share()) continue;
        error_ = held_[cloth];
        allowed_ = allowed;
    }
}

double MotionError::at_end() const {
    const TimeSettings& time = model_.scene.time;
    const double now = std::max(last_frame_ / time.fps, least_time), end = (time.frame_count - 1) / time.fps;
    return error_ * std::max(1.0, end / now);
}

}  // namespace drape
