// How far a run's positions are from those of the exact motion. A companion tells: the same scene, simulated beside the
// run from the start with other substeps, and never reset to it. What the dynamics make of an error (a wrong velocity
// carries on, a swing brings it back, damping takes it away) therefore happens in the companion as well.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// The stated error is within this factor of the true one in four of five scenes (docs/accuracy.md).
inline constexpr double motion_error_confidence = 3;
/// s, within which a distance that comparisons no longer show decays to 1/e.
inline constexpr double motion_error_hold = 1.5;

/// Returns whether the runs are compared at the end of `last`, a segment's last frame: at the end of every probe, and
/// otherwise once per probe's length, since every comparison waits for the device.
bool compares_at(const SimulationModel& model, std::uint32_t last, bool probes);

class MotionError {
  public:
    explicit MotionError(const SimulationModel& model);

    /// Takes each cloth's RMS distance (m) from the companion at the end of a frame that had so many substeps.
    void saw(std::uint32_t frame, std::uint32_t substeps, std::span<const double> apart);
    /// Returns the estimated RMS position error, m, of the cloth whose error is the largest share of what is allowed;
    /// NaN where nothing was compared.
    double error() const { return error_; }
    /// Returns the error that the motion's limit allows this cloth until then, m: the limit (m/s) times the time, but
    /// at least half a second, since an error may grow to its size at half a second much sooner.
    double allowed() const { return allowed_; }
    /// Returns the error divided by what is allowed; 0 where nothing was compared.
    double share() const { return std::isnan(error_) ? 0 : error_ / allowed_; }

    /// Returns how fast the worst cloth's error grew between the last two comparisons, divided by the motion's limit.
    double growth() const { return growth_; }

    /// Returns the error in the scene's last frame, m, if it keeps growing in proportion to time.
    double at_end() const;

    /// Writes or reads what is known. Returns whether what was read is possible.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(held_, apart_, growth_, ratio_, weight_, last_frame_, error_, allowed_);
        return held_.size() == model_.cloths.size() && apart_.size() == held_.size();
    }

  private:
    double order() const;
    void weigh(std::uint32_t substeps, double passed, double kept);

    const SimulationModel& model_;
    std::vector<double>
        held_;  ///< by cloth, m: the error is kept for a while, since two runs of a swing meet now and then
    std::vector<double> apart_;  ///< by cloth, m: the distances that were compared last
    double growth_ = 0;
    double ratio_ = 1;   ///< of the companion's time step to the run's, averaged over the time in which errors arose
    double weight_ = 0;  ///< the weight of that average
    std::uint32_t last_frame_ = 0;
    double error_ = std::numeric_limits<double>::quiet_NaN(), allowed_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace drape
