#include "control/named_pilot.h"

namespace drape {

NamedPilot::NamedPilot(const SimulationModel& model)
    : model_(model), companion_substeps_(model.scene.solver.substeps), position_error_(model), sensitivity_(model) {}

Work NamedPilot::frame_in(StateSet set, std::uint32_t substeps, std::uint32_t history_substeps) const {
    Work work;
    work.frame = simulated_;
    work.set = set;
    if (model_.self_contact)
        work.before = StateStep::keep;  // the frame is done again if contact's lists of pairs turn out too short
    work.simulates = true;
    work.substeps = substeps;
    work.history_substeps = history_substeps;
    return work;
}

std::optional<Work> NamedPilot::next_work() {
    if (!next_) return std::nullopt;
    const std::uint32_t own = model_.scene.solver.substeps;
    if (next_ == StateSet::companion) {
        const std::uint32_t history = companion_substeps_;
        companion_substeps_ = model_.companion_substeps(own);
        next_ = StateSet::run;
        return frame_in(StateSet::companion, companion_substeps_, history);
    }
    Work work = frame_in(StateSet::run, own, own);
    if (model_.has_companions()) work.after = StateStep::compare_companion;
    work.hands_out = true;
    next_.reset();
    ++simulated_;
    return work;
}

FrameEffort NamedPilot::take(const Work& work, const WorkResult& result) {
    FrameEffort effort;
    effort.substeps = work.simulates ? work.substeps : 0;
    if (work.after != StateStep::compare_companion) return effort;
    position_error_.saw(work.frame, work.substeps, result.differences);
    note_motion(position_error_, sensitivity_, effort);
    return effort;
}

template <class Archive>
bool NamedPilot::transfer(Archive& archive) {
    archive(companion_substeps_, simulated_);
    const std::uint32_t own = model_.scene.solver.substeps;
    const bool can_be = companion_substeps_ == own ||
                        (model_.has_companions() && companion_substeps_ == model_.companion_substeps(own));
    return position_error_.transfer(archive) && can_be;
}

void NamedPilot::write(ByteWriter& writer) const { const_cast<NamedPilot*>(this)->transfer(writer); }

void NamedPilot::read(ByteReader& reader) {
    next_.reset();
    if (!transfer(reader)) throw Error("not as many cloths that have errors");
}

}  // namespace drape
