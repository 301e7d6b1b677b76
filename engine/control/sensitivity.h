// Tells chaos from error. Where cloth crumples, or leaves an equilibrium that does not last, two motions that start
// with the slightest difference diverge, however exactly each is computed. To find out, another run begins where the
// error first matters, where substeps do not reduce it, or at the start of a scene whose cloth starts in balance
// (control/balance.h): the companion's state at that time (control/motion_error.h), disturbed by a millionth of the
// cloth's size. As far as the two diverge, and no farther, the estimated error is excused.
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
    /// Returns whether the disturbed run still parts from the companion, by too little to matter so far.
    bool undecided() const { return runs_ && !sensitive_; }
    /// Returns whether equally exact runs have at some time diverged by a good share of the estimated error.
    bool is_sensitive() const { return sensitive_; }
    /// Returns whether they are as far apart now.
    bool excuses() const { return excuses_; }
    /// Returns whether they have for a while been as far apart as the companion is from the run: it tells nothing more,
    /// and neither it nor the disturbed run goes on.
    bool is_lost() const { return lost_; }
    /// Returns how far apart they were when they were last compared, m; it is kept for a while, as the error is.
    double parted() const { return parted_; }

    /// Writes or reads what is known.
    template <class Archive>
    void transfer(Archive& archive) {
        archive(runs_, sensitive_, excuses_, lost_, ended_, covered_, seen_, parted_, mark_.frame, mark_.parted);
    }

  private:
    double seconds(std::uint32_t frames) const { return frames / model_.scene.time.fps; }

    const SimulationModel& model_;
    bool runs_ = false, sensitive_ = false, excuses_ = false, lost_ = false;
    std::uint32_t ended_ = 0;    ///< the frame in which the last disturbed run that showed no chaos ended
    std::uint32_t covered_ = 0;  ///< the last frame in which runs were nearer to each other than the error
    std::uint32_t seen_ = 0;     ///< the last frame that was compared
    double parted_ = 0;
    struct Mark {
        std::uint32_t frame = 0;
        double parted = 0;
    } mark_;  ///< how far they were apart up to a second ago
};

/// Writes what is known about the motion's error into a frame's effort.
void note_motion(const MotionError& error, const Sensitivity& sensitivity, FrameEffort& effort);

}  // namespace drape
