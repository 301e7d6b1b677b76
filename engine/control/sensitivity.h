// Tells chaos from error. Where cloth crumples, two motions that differ by nothing part, however exactly each is
// computed, and no number of substeps brings the companion (control/motion_error.h) back. To know it another run is
// begun where the error first matters, or substeps do not reduce it: the companion as it is then, disturbed by a
// millionth of the cloth's size. If the two part as far as the estimated error says, positions have no truth from there
// on: no error of them is stated any more, and no run is needed beside the run.
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
    /// substeps do not reduce a probe's error, whatever the companion says: where cloth buckles two runs may happen to
    /// go one way.
    bool begins(std::uint32_t frame, const MotionError& error, bool predictable) const;
    void begin(std::uint32_t frame);
    bool runs() const { return runs_; }
    /// Takes each cloth's distance (m) from the disturbed run at the end of a frame.
    void saw(std::uint32_t frame, std::span<const double> distances, const MotionError& error);
    /// Returns whether equally exact runs were found to part as far as the estimated error, or as what is allowed.
    bool is_sensitive() const { return sensitive_; }
    /// Returns how far apart they were when they were last compared, m.
    double parted() const { return parted_; }

    /// Writes or reads what it knows.
    template <class Archive>
    void transfer(Archive& archive) {
        archive(runs_, sensitive_, begun_, ended_, parted_);
    }

  private:
    const SimulationModel& model_;
    bool runs_ = false, sensitive_ = false;
    std::uint32_t begun_ = 0, ended_ = 0;  ///< frames; the second is that of the last run that told nothing
    double parted_ = 0;
};

/// Writes what is known of the motion into a frame's effort.
void note_motion(const MotionError& error, const Sensitivity& sensitivity, FrameEffort& effort);

}  // namespace drape
