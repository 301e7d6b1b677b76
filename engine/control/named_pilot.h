// The pilot of a named method simulates every frame once, with the substeps that the scene says. Where the position
// error is to be reported, the companion simulates each frame first (control/motion_error.h).
#pragma once

#include "control/motion_error.h"
#include "control/pilot.h"
#include "control/sensitivity.h"

namespace drape {

class NamedPilot : public Pilot {
  public:
    explicit NamedPilot(const SimulationModel& model);

    std::uint32_t simulated() const override { return simulated_; }
    void begin() override { next_ = model_.has_companions() ? StateSet::companion : StateSet::run; }
    std::optional<Work> next_work() override;
    FrameEffort take(const Work& work, const WorkResult& result) override;
    void abandon(const Work&) override {}
    void attempt_anew() override {}
    const KeptFrames* kept() const override { return nullptr; }
    const std::optional<FrameFailure>& refusal() const override { return refusal_; }
    void wake() override {}
    std::uint32_t state_substeps() const override { return model_.scene.solver.substeps; }
    void write(ByteWriter& writer) const override;
    void read(ByteReader& reader) override;

  private:
    template <class Archive>
    bool transfer(Archive& archive);
    Work frame_in(StateSet set, std::uint32_t substeps, std::uint32_t history_substeps) const;

    const SimulationModel& model_;
    std::uint32_t simulated_ = 1;
    std::uint32_t companion_substeps_;  ///< of the companion's history
    std::optional<StateSet> next_;      ///< the next frame is simulated in this set; nothing: the frame is done
    MotionError position_error_;
    Sensitivity sensitivity_;              ///< never begins: only the closed loop uses it
    std::optional<FrameFailure> refusal_;  ///< stays empty
};

}  // namespace drape
