// Tells chaos from error. Where cloth crumples, two motions that start with the slightest difference diverge, however
// exactly each is computed, and no number of substeps brings the companion (control/motion_error.h) back. To find out,
// another run begins where the error first matters, or where substeps do not reduce it: the companion's state at that
// time, disturbed by a millionth of the cloth's size. If the two diverge as far as the estimated error says, positions
// cannot be predicted from there on: their error is no longer stated, and neither companion nor disturbed run is needed
// any more.
#pragma once

#include <cstdint>
#include <span>

#include "control/motion_error.h"
#include "drape/frame.h"

namespace drape {

class Sensitivity {
  public:
    explicit Sensitivity(const SimulationModel& model) : model_(model) {}

    /// Returns whether the disturbed run is to begin at the end of this frame. A frame is not `predictable` where more
    /// substeps do not reduce a probe's error. The companion cannot overrule this: where cloth buckles, two runs may
    /// happen to buckle the same way.
    bool begins(std::uint32_t frame, const MotionError& error, bool predictable) const;
    void begin(std::uint32_t frame);
    bool runs() const { return runs_; }
    /// Takes each cloth's distance (m) from the disturbed run at the end of a frame.
    void saw(std::uint32_t frame, std::span<const double> distances, const MotionError& error);
    /// Returns whether equally exact runs diverged as far as the estimated error, or as far as an error is allowed.
    bool is_sensitive() const { return sensitive_; }
    /// Returns how far apart the runs were when they were last compared, m.
    double parted() const { return parted_; }

    /// Writes or reads what is known.
    template <class Archive>
    void transfer(Archive& archive) {
        archive(runs_, sensitive_, begun_, ended_, parted_);
    }

  private:
    const SimulationModel& model_;
    bool runs_ = false, sensitive_ = false;
    std::uint32_t begun_ = 0,
                  ended_ =
                      0;  ///< frames: when the disturbed run began, and when the last one that showed no chaos ended
    double parted_ = 0;
};

/// Writes what is known about the motion's error into a frame's effort.
void note_motion(const MotionError& error, const Sensitivity& sensitivity, FrameEffort& effort);

}  // namespace drape
