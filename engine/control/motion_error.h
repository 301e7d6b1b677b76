// How far a run's positions are from those of the exact motion, told by a companion: the same scene run beside it from
// the start, with other substeps, and never brought back to it. So what the dynamics make of an error (a velocity that
// is wrong carries on, a swing brings it back, damping takes it) happens to the companion's as well.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// The stated error is within this factor of the true one in four of five scenes (docs/accuracy.md).
inline constexpr double motion_error_confidence = 3;

/// Returns whether runs are compared at the end of frame `last` of a segment: at that of a probe, and as often as
/// probes are long, since every comparison waits for the device.
bool compares_at(const SimulationModel& model, std::uint32_t last, bool probes);

class MotionError {
  public:
    explicit MotionError(const SimulationModel& model);

    /// Takes, at the end of a frame of so many substeps, each cloth's RMS distance (m) from the companion's.
    void saw(std::uint32_t frame, std::uint32_t substeps, std::span<const double> apart);
    /// Returns the estimated RMS position error of the worst cloth, m; NaN where nothing was seen.
    double error() const { return error_; }
    /// Returns the estimate over what the motion's limit allows until then, of the worst cloth.
    double share() const { return share_; }
    /// Returns what it allows until then, m: the limit (m/s) times the time, of half a second at least, before which an
    /// error is about as large as it will be then.
    double allowed() const { return share_ > 0 ? error_ / share_ : std::numeric_limits<double>::quiet_NaN(); }

    /// Returns what it will be in the scene's last frame if it goes on growing in proportion to time, m.
    double at_end() const;

    /// Writes or reads what it knows. Returns whether what was read can be.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(held_, ratio_, weight_, last_frame_, error_, share_);
        return held_.size() == model_.cloths.size();
    }

  private:
    double order() const;
    void weigh(std::uint32_t substeps, double passed, double kept);

    const SimulationModel& model_;
    std::vector<double> held_;  ///< by cloth, m: errors hold on, since runs of a swing meet now and then
    double ratio_ = 1;          ///< of the companion's step to the run's, with which errors were made
    double weight_ = 0;         ///< of what was made so far
    std::uint32_t last_frame_ = 0;
    double error_ = std::numeric_limits<double>::quiet_NaN(), share_ = 0;
};

}  // namespace drape
