// How far a run's positions are from those of the exact motion, told by a companion: the same scene run beside it from
// the start, with other substeps, and never brought back to it. So what the dynamics make of an error (a velocity that
// is wrong carries on, a swing brings it back, damping takes it) happens to the companion's as well.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cloth/method.h"
#include "cloth/simulation_model.h"

namespace drape {

/// The stated error is within this factor of the true one in four of five scenes (docs/accuracy.md).
inline constexpr double motion_error_confidence = 3;

/// Returns the substeps of the companion of a frame: a quarter, a half where that would be fewer than two. Explicit
/// steps, which soften the cloth where they are fewer than `auto` takes, have half as many more.
std::uint32_t companion_substeps(const Method& method, std::uint32_t substeps);

/// Returns Richardson's estimate of the error over the distance from the companion: an error that falls with the
/// substeps n to the power p is 1 over |(n / n_companion)^p - 1| of it. p lies between 1 (contact) and 2 (free motion
/// that many substeps resolve); measured over scenes and substeps it is 1.4.
double error_over_distance(const Method& method, std::uint32_t substeps);

class MotionError {
  public:
    explicit MotionError(const SimulationModel& model);

    /// Takes each cloth's RMS distance (m) from the companion's at the end of a frame of so many substeps.
    void saw(std::uint32_t frame, std::span<const double> distances, std::uint32_t substeps);
    /// Returns the estimated RMS position error of the worst cloth, m; NaN where nothing was seen.
    double error() const { return error_; }
    /// Returns the estimate over what the motion's limit allows until then, of the worst cloth.
    double share() const { return share_; }
    /// Returns what it allows until then, m: the limit (m/s) times the time.
    double allowed() const { return share_ > 0 ? error_ / share_ : std::numeric_limits<double>::quiet_NaN(); }

    /// Writes or reads what it knows. Returns whether what was read can be.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(distances_, errors_, held_, last_frame_, error_, share_);
        const std::size_t count = model_.cloths.size();
        return distances_.size() == count && errors_.size() == count && held_.size() == count;
    }

  private:
    const SimulationModel& model_;
    std::vector<double> distances_, errors_;  ///< by cloth, m, at the last frame
    std::vector<double> held_;                ///< errors that hold on: the two runs of a swing meet now and then
    std::uint32_t last_frame_ = 0;
    double error_ = std::numeric_limits<double>::quiet_NaN(), share_ = 0;
};

}  // namespace drape
