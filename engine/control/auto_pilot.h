// The closed loop of method `auto`: it simulates frames, judges them by a few numbers, and keeps them or does them
// again from their start with more substeps (control/substep_control.h). After frames are kept, the companion simulates
// the same frames, and at times the disturbed run does (control/motion_error.h, control/sensitivity.h).
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
    /// The work on a segment passes through these phases in order, and skips a phase that it does not need.
    enum class Phase {
        done,
        asleep,     ///< hands out the previous frame again
        coarse,     ///< simulates a probe's frames with half the substeps
        fine,       ///< simulates the segment's frames
        hand_out,   ///< hands out a frame of the probe other than its last
        companion,  ///< simulates the segment's frames in the companion's state set
        disturbed,  ///< simulates them in the disturbed run's state set
        compare_companion,
        compare_disturbed,
        disturb,  ///< begins the disturbed run
        finish,   ///< hands out the segment's last frame
        restore   ///< restores the state from before the abandoned work
    };
    /// The attempt at a segment.
    struct Attempt {
        Phase phase = Phase::done;
        std::uint32_t next = 0;  ///< the frame of the segment that the phase does next
        bool keeps = true;       ///< the state at the start of the segment has yet to be saved
        Judgement judgement = {};
        KnownFrame last = {};                      ///< the last frame that was simulated in the run
        std::optional<FrameFailure> refusal = {};  ///< why the attempt misses what `auto` promises
    };
    /// What is known about the error of the motion.
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
    /// Goes to the next phase after all frames of `done`, the companion's or the disturbed run's state set, are done.
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
    KeptFrames kept_;  ///< the frames of the attempt so far; after the attempt, those that were kept
    std::vector<ClothStatistics> before_;  ///< of the last frame that was kept; empty: none was
    std::vector<std::byte> begun_;         ///< what `write` would have written at `begin`
};

}  // namespace drape
