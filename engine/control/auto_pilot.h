// The closed loop of method `auto`: frames are simulated, judged by a few numbers, and kept or done again from their
// start with more substeps (control/substep_control.h). After frames that are kept their companion follows, and at
// times the disturbed run (control/motion_error.h, control/sensitivity.h).
#pragma once

#include <string>

#include "control/drive.h"
#include "control/frame_judgement.h"
#include "control/motion_error.h"
#include "control/pilot.h"
#include "control/sensitivity.h"
#include "control/sleep.h"
#include "control/substep_control.h"
#include "control/watch.h"

namespace drape {

class AutoPilot : public Pilot {
  public:
    explicit AutoPilot(const SimulationModel& model);

    std::uint32_t simulated() const override { return simulated_; }
    void begin() override;
    std::optional<Work> next_work() override;
    FrameEffort take(const Work& work, const WorkResult& result) override;
    void abandon(const Work& refused) override;
    void attempt_anew() override;
    const KeptFrames* kept() const override { return &kept_; }
    const std::optional<FrameFailure>& refusal() const override { return attempt_.refusal; }
    void wake() override { sleep_.wake(); }
    std::uint32_t state_substeps() const override { return histories_[0]; }
    void write(ByteWriter& writer) const override;
    void read(ByteReader& reader) override;

  private:
    /// The work goes through these in order, but for what is not needed.
    enum class Phase {
        done,
        asleep,     ///< hands out the frame before again
        coarse,     ///< a probe's frames with half the substeps
        fine,       ///< the segment's frames
        hand_out,   ///< a probe's frame, which is not the last
        companion,  ///< the segment's frames in this set
        disturbed,  ///< the same in this one
        compare_companion,
        compare_disturbed,
        disturb,  ///< begins the disturbed run
        finish,   ///< hands out the segment's last frame
        restore   ///< takes back what was abandoned
    };
    /// The attempt at a segment.
    struct Attempt {
        Phase phase = Phase::done;
        std::uint32_t next = 0;  ///< the segment's frame that the phase does next
        bool keeps = true;       ///< what the segment starts from is yet to be kept
        Judgement judgement = {};
        KnownFrame last = {};                      ///< the last frame that was run
        std::optional<FrameFailure> refusal = {};  ///< why it misses what is promised
    };
    /// What is known of the motion's error.
    struct Stated {
        MotionError error;
        Sensitivity sensitivity;
    };

    template <class Archive>
    bool transfer(Archive& archive);
    bool is_last() const { return attempt_.next + 1 == control_.segment().frame_count; }
    bool probes() const { return control_.segment().probes; }
    Work frame_in(StateSet set, std::uint32_t substeps);
    /// Returns the attempt's next frame, with a step at the end of the segment.
    Work attempted(std::uint32_t substeps, std::optional<StateStep> at_end);
    Work frame_beside(StateSet set);
    Work handed_out(std::uint32_t frame) const;
    void begin_attempt();
    void take_coarse(const WorkResult& result);
    void take_fine(const Work& work, const WorkResult& result);
    double motion_of(std::span<const double> differences);
    void conclude();
    void refuse();
    void keep();
    /// Goes on where the frames of a set beside the run are done.
    void follow(StateSet done);
    void take_differences(StateStep step, std::span<const double> differences);
    void finish();

    const SimulationModel& model_;
    SubstepControl control_;
    Watch watch_;
    Sleep sleep_;
    Drive drive_;
    Stated stated_;
    Histories histories_;
    std::uint32_t simulated_ = 1;
    Attempt attempt_;
    KeptFrames kept_;                      ///< the frames of the attempt so far; behind it those that were kept
    std::vector<ClothStatistics> before_;  ///< of the last frame that was kept; empty: there was none
    std::vector<std::byte> begun_;         ///< what `write` would have written at `begin`
};

}  // namespace drape
