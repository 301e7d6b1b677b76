// What drives cloths can be read from the scene in advance; where it increases, the motion is probed.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns for each cloth the largest acceleration within a frame, m/s^2: gravity, the wind's pull (hang.h), and the
/// accelerations of pins and colliders that move. A pin that has let go drives nothing.
std::vector<double> drive_of(const SimulationModel& model, std::uint32_t frame);

class Drive {
  public:
    /// `model` is that of a closed loop, and must outlive this.
    explicit Drive(const SimulationModel& model) : model_(model) {}

    /// Returns whether something happens in the frame that the last probe says nothing about: a pin lets go, or a cloth
    /// is driven so much harder than in the probe that the substeps found sufficient there may be too few.
    bool eventful(std::uint32_t frame) const;
    /// Notes that `count` frames from `frame` on are probed.
    void probed(std::uint32_t frame, std::uint32_t count);

    /// Writes or reads what changes, as SubstepControl::transfer does.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(probed_);
        return probed_.empty() || probed_.size() == model_.cloths.size();
    }

  private:
    const SimulationModel& model_;
    std::vector<double>
        probed_;  ///< by cloth, the largest drive in the last probe's frames, m/s^2; empty: there was no probe
};

}  // namespace drape
