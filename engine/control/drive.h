// A scene tells ahead what drives its cloths: where that rises, the motion is probed.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns per cloth the most of a frame, m/s^2: gravity, the wind's pull (hang.h), and what pins and colliders that
/// move are accelerated by. A pin that has let go drives nothing.
std::vector<double> drive_of(const SimulationModel& model, std::uint32_t frame);

class Drive {
  public:
    /// `model` is that of a closed loop, and must outlive this.
    explicit Drive(const SimulationModel& model) : model_(model) {}

    /// Returns whether something happens in the frame that the last probe tells nothing of: a pin lets go, or a cloth
    /// is driven by so much more than it was there that what was found easy need not be.
    bool eventful(std::uint32_t frame) const;
    /// Notes that so many frames from `frame` on are probed.
    void probed(std::uint32_t frame, std::uint32_t count);

    /// Writes or reads what changes, like SubstepControl's.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(probed_);
        return probed_.empty() || probed_.size() == model_.cloths.size();
    }

  private:
    const SimulationModel& model_;
    std::vector<double> probed_;  ///< per cloth, the most of the last probe's frames, m/s^2; empty: there was none
};

}  // namespace drape
