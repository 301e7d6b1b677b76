// The twin of a closed loop: the pilot of the device (control/auto_pilot.h) says what the twins simulate. The scene
// must have no cutters and nothing that tears.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "control/auto_pilot.h"
#include "twin/twin.h"

namespace drape {

class TwinLoop {
  public:
    /// `model` must be one of a closed loop and outlive this.
    explicit TwinLoop(const SimulationModel& model);

    /// Runs the frames from the next one to `last` and calls `finished` for each in order, with the twin at the frame's
    /// end. A segment that goes beyond `last` is run to its end.
    void run(std::uint32_t last,
             const std::function<void(std::uint32_t frame, const Twin& twin, const FrameEffort& effort)>& finished);

  private:
    const SimulationModel& at(std::uint32_t substeps);
    WorkResult done(const Work& work);
    void do_step(StateStep step, const Work& work, WorkResult& result);
    std::vector<ClothStatistics> statistics(Twin& twin, std::uint32_t frame, const SimulationModel& run) const;
    std::vector<double> differences(const Twin& fine, const Twin& coarse) const;
    Twin& in(StateSet set) { return states_[static_cast<std::size_t>(set)]; }

    const SimulationModel& model_;
    std::map<std::uint32_t, std::unique_ptr<SimulationModel>> runs_;
    AutoPilot pilot_;
    std::vector<Twin> states_;  ///< by set
    std::map<StateSet, Twin> kept_;
    std::optional<Twin> remembered_;
    std::uint32_t next_ = 1;
};

}  // namespace drape
