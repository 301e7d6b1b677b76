// Beside a run others are simulated in images of their own: the companion (control/motion_error.h), in a closed loop
// after each segment that is kept, and there at times the disturbed run (control/sensitivity.h). Nothing of them is
// handed out but how far they are from the run.
#include <algorithm>
#include <cstring>

#include "cloth/substep_change.h"
#include "simulation/frame_loop.h"

namespace drape {

FrameLoop::Frame FrameLoop::build_beside(const SimulationModel& run, StateSet set) {
    Frame frame;
    solver_.declare(frame.graph, {}, run, set);
    solver_.add_simulation(frame.graph);
    frame.plan = graph::make_plan(frame.graph);
    return frame;
}

void FrameLoop::submit_beside(StateSet set, std::uint32_t slot, std::uint32_t frame, std::uint32_t substeps) {
    const std::uint32_t before = beside_substeps_[static_cast<std::size_t>(set)];
    LaneWork work{
        .frame = frame, .run = rung(substeps, set).model.get(), .changes = substep_changes(model_, before, substeps)};
    if (model_.self_contact) work.parts.push_back({LanePart::Kind::attempt, set, AttemptStep::keep});
    if (substeps != before) work.parts.push_back({LanePart::Kind::attempt, set, AttemptStep::change_substep});
    work.parts.push_back({LanePart::Kind::substeps, set, {}, substeps});
    submit_parts(slot, work);
}

bool FrameLoop::lengthen_lists_of(StateSet set, std::uint32_t slot, const Finished& finished) {
    if (!model_.self_contact) return false;
    wait(slot);
    const glsl::SelfRecord record = self_record_in(slot);
    if (solver_.self_list_use(record) <= 1 || !solver_.grow_lists(record)) return false;
    deliver_all(finished);
    submit_parts(slot, {.parts = {{LanePart::Kind::attempt, set, AttemptStep::restore}}});
    wait(slot);
    rebuild_resources(solver_.download_state(*pool_));
    return true;
}

void FrameLoop::follow(StateSet set, std::uint32_t frame, std::uint32_t count, std::uint32_t substeps,
                       const Finished& finished) {
    for (std::uint32_t k = 0; k < count; ++k) {
        std::uint32_t slot = 0;
        do {
            slot = take_slot(finished);
            submit_beside(set, slot, frame + k, substeps);
        } while (lengthen_lists_of(set, slot, finished));
        beside_substeps_[static_cast<std::size_t>(set)] = substeps;
    }
}

std::vector<double> FrameLoop::compared(AttemptStep step, const Finished& finished) {
    const std::uint32_t slot = take_slot(finished);
    submit_parts(slot, {.parts = {{LanePart::Kind::attempt, StateSet::run, step}}});
    wait(slot);
    return differences_in(slot);
}

void FrameLoop::follow_segment(std::uint32_t frame, bool predictable, const Finished& finished) {
    if (!model_.has_companions()) return control_->accumulated(unknown_share);
    if (sensitivity_.is_sensitive()) return;  // there is no error that could be told
    const Segment& segment = control_->segment();
    const std::uint32_t last = frame + segment.frame_count - 1;
    const std::uint32_t beside = model_.companion_substeps(segment.substeps);
    follow(StateSet::companion, frame, segment.frame_count, beside, finished);
    if (sensitivity_.runs()) follow(StateSet::disturbed, frame, segment.frame_count, beside, finished);
    if (!compares_at(model_, last, segment.probes)) return;
    position_error_.saw(last, segment.substeps, compared(AttemptStep::compare_companion, finished));
    if (sensitivity_.runs())
        sensitivity_.saw(last, compared(AttemptStep::compare_disturbed, finished), position_error_);
    if (sensitivity_.begins(last, position_error_, predictable)) {
        sensitivity_.begin(last);
        const std::uint32_t slot = take_slot(finished);
        submit_parts(slot, {.parts = {{LanePart::Kind::attempt, StateSet::run, AttemptStep::disturb}}});
        beside_substeps_[static_cast<std::size_t>(StateSet::disturbed)] = beside;
    }
    control_->accumulated(sensitivity_.is_sensitive() ? 0 : position_error_.share());
}

}  // namespace drape
