// The twin of the closed loop asks the same control the same questions about the twin's frames. The scene must have no
// cutters.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "control/drive.h"
#include "control/frame_judgement.h"
#include "control/motion_error.h"
#include "control/sensitivity.h"
#include "control/sleep.h"
#include "control/substep_control.h"
#include "control/watch.h"
#include "drape/simulation.h"
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
    Judgement attempt(std::uint32_t frame, std::vector<Twin>& frames);
    std::vector<ClothStatistics> statistics(Twin& twin, std::uint32_t frame, const SimulationModel& run) const;
    double motion(const Twin& fine, const Twin& coarse);
    std::vector<double> differences(const Twin& fine, const Twin& coarse) const;
    /// A run beside the one that is handed out.
    struct Beside {
        Twin twin;
        std::uint32_t substeps;  ///< of its history
    };
    void follow(Beside& beside, std::uint32_t substeps);
    void follow_segment(const Twin& end, FrameEffort& effort);

    const SimulationModel& model_;
    std::map<std::uint32_t, std::unique_ptr<SimulationModel>> runs_;
    SubstepControl control_;
    Watch watch_;
    Sleep sleep_;
    Drive drive_;
    std::vector<std::vector<ClothStatistics>> attempt_statistics_;
    std::vector<ClothStatistics> before_;  ///< statistics of what the segment starts from
    Twin state_;
    std::uint32_t next_ = 1, state_substeps_;
    Beside companion_, disturbed_;
    double motion_error_ = 0;
    MotionError position_error_;
    Sensitivity sensitivity_;
};

}  // namespace drape
