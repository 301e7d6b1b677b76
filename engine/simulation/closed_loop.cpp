// The closed loop of method `auto` on the device: frames are simulated, judged on the host by a few numbers that the
// device reduces, and either kept and handed out or done again from their start with more substeps. While a frame is
// judged the device has nothing to do for as long as the host takes to answer, tens of microseconds; speculating on the
// answer would draw pictures of frames that fail.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "cloth/substep_change.h"
#include "control/impossible_scene.h"
#include "control/passage_watch.h"
#include "simulation/frame_loop.h"

namespace drape {

void FrameLoop::for_each_attempt(const std::function<void(Frame&)>& visit) {
    for (std::size_t set = 0; set < state_set_count; ++set)
        for (const AttemptStep step : attempt_steps(model_, static_cast<StateSet>(set)))
            visit(attempt(step, static_cast<StateSet>(set)));
}

void FrameLoop::build_attempts() {
    for (std::size_t set = 0; set < state_set_count; ++set)
        for (const AttemptStep step : attempt_steps(model_, static_cast<StateSet>(set))) {
            Frame frame;
            solver_.declare(frame.graph, {}, model_, static_cast<StateSet>(set));
            solver_.add_attempt(frame.graph, step);
            frame.plan = graph::make_plan(frame.graph);
            attempt(step, static_cast<StateSet>(set)) = std::move(frame);
        }
}

void FrameLoop::submit_run(std::uint32_t slot, const Run& run, const Attempt& attempt, const Asked& asked) {
    if (asked.stop && asked.stop()) throw Stopped();
    if (options_.on_attempt) options_.on_attempt({run.frame, run.substeps, attempt.number});
    LaneWork work{.frame = run.frame,
                  .run = rung(run.substeps).model.get(),
                  .changes = substep_changes(model_, state_substeps_, run.substeps)};
    const auto add = [&](AttemptStep step) { work.parts.push_back({LanePart::Kind::attempt, StateSet::run, step}); };
    if (run.before) add(*run.before);
    if (run.begins && run.substeps != state_substeps_) add(AttemptStep::change_substep);
    work.parts.push_back({LanePart::Kind::substeps, StateSet::run, {}, run.substeps});
    if (run.after) add(*run.after);
    submit_parts(slot, work);
    kept_ = kept_ || run.before == AttemptStep::keep;
    if (options_.meanwhile) options_.meanwhile();
}

FrameLoop::Judged FrameLoop::take_judged(std::uint32_t slot, std::uint32_t frame, std::uint32_t substeps) {
    wait(slot);
    const Rung& rung = this->rung(substeps);
    Judged judged{statistics_in(slot, frame, *rung.model), {.substeps = substeps}, {}};
    if (rung.frame.recorded)
        for (graph::Timing& timing : rung.frame.recorded->timings(slot))
            judged.timings.push_back({std::move(timing.name), timing.milliseconds});
    judged.self_record = self_record_in(slot);
    fullest_.most_pairs = std::max(fullest_.most_pairs, judged.self_record.most_pairs);
    fullest_.most_near = std::max(fullest_.most_near, judged.self_record.most_near);
    fullest_.most_cells = std::max(fullest_.most_cells, judged.self_record.most_cells);
    fullest_.most_touching = std::max(fullest_.most_touching, judged.self_record.most_touching);
    return judged;
}

void FrameLoop::run_coarse(const Attempt& attempt, Judgement& judgement, const Asked& asked) {
    const Segment& segment = control_->segment();
    for (std::uint32_t k = 0; k < segment.frame_count; ++k) {
        const std::uint32_t slot = take_slot(withhold_);
        Run run{attempt.frame + k, segment.substeps / 2, {}, {}, k == 0};
        if (k == 0) run.before = attempt.keeps ? AttemptStep::keep : AttemptStep::restore;
        if (k + 1 == segment.frame_count) run.after = AttemptStep::remember;
        submit_run(slot, run, attempt, asked);
        judgement.coarse_stretch = std::max(
            judgement.coarse_stretch, stretch_judgement(model_, take_judged(slot, run.frame, run.substeps).statistics));
    }
}

/// Returns the estimated error over its limit, of the worst cloth.
double FrameLoop::motion_of(std::uint32_t slot) {
    const std::vector<double> differences = differences_in(slot);
    double worst = motion_error_ = 0;
    for (std::size_t cloth = 0; cloth < differences.size(); ++cloth) {
        const double error = motion_error(model_, differences[cloth], control_->segment().frame_count);
        if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, error / motion_limit(model_, cloth));
        motion_error_ = std::max(motion_error_, error);
    }
    return worst;
}

/// Returns the facts of the last frame that was run: the segment's last, unless one before it failed.
FrameLoop::Judged FrameLoop::run_fine(const Attempt& attempt, Judgement& judgement, const Asked& asked) {
    const Segment& segment = control_->segment();
    const Finished& finished = segment.probes ? withhold_ : asked.finished;
    Judged judged;
    attempt_statistics_.clear();
    attempt_self_records_.clear();
    for (std::uint32_t k = 0; k < segment.frame_count; ++k) {
        const bool last = k + 1 == segment.frame_count;
        const std::uint32_t slot = take_slot(finished), frame = attempt.frame + k;
        Run run{frame, segment.substeps, {}, {}, k == 0};
        if (k == 0) run.before = attempt.keeps && !segment.probes ? AttemptStep::keep : AttemptStep::restore;
        if (last && segment.probes) run.after = AttemptStep::compare;
        submit_run(slot, run, attempt, asked);
        deliver(next_slot_, finished);  // hands out the frame before while this one is simulated
        judged = take_judged(slot, frame, run.substeps);
        judgement.passage = std::max(
            judgement.passage, passage_judgement(model_, frame, run.substeps,
                                                 k == 0 ? before_ : attempt_statistics_.back(), judged.statistics));
        if (self_contact_) judgement.lag = std::max(judgement.lag, lag_judgement(model_, judged.self_record));
        attempt_statistics_.push_back(judged.statistics);
        attempt_self_records_.push_back(judged.self_record);
        const double implausible =
            std::max(watch_.excess(frame, judged.statistics), solver_.self_list_use(judged.self_record));
        judgement.plausible = judgement.plausible && implausible <= 1;
        judgement.stretch = std::max(judgement.stretch, stretch_judgement(model_, judged.statistics));
        judgement.watch = std::max(judgement.watch, implausible);
        if (control_->fails(judgement)) return judged;
        if (!segment.probes) return judged;
        if (last) judgement.motion = motion_of(slot);
        submit_output(frame, judged, frame > asked.last || asked.wanted(frame), withhold_);
    }
    return judged;
}

/// Hands out a frame that is the one before it. Nothing moves in it; what wakes has the velocity that it fell asleep
/// with.
void FrameLoop::sleep_through(std::uint32_t frame, const Asked& asked) {
    simulated_ = frame + 1;
    Judged still{attempt_statistics_.back(), {.attempts = 0, .asleep = true}, {}};
    note_motion(position_error_, sensitivity_, still.effort);
    for (ClothStatistics& cloth : still.statistics) cloth.kinetic_energy = cloth.largest_speed = 0;
    const bool wanted = asked.wanted(frame);
    if (!wanted) pass_over(frame, still.statistics, still.effort);
    submit_output(frame, std::move(still), wanted, asked.finished);
}

void FrameLoop::drop_withheld() {
    deliver_all([](const FinishedFrame&) {});
    withheld_.clear();
}

bool FrameLoop::lengthen_lists() {
    if (solver_.self_list_use(fullest_) <= 1 || !solver_.grow_lists(fullest_)) return false;
    if (control_->segment().probes) drop_withheld();
    begin_anew();
    kept_ = false;
    return true;
}

bool FrameLoop::simulate_unless_stopped(std::uint32_t frame, const Asked& asked) {
    const std::vector<std::byte> before = host_state();
    kept_ = false;
    in_segment_ = true;
    bool stopped = false;
    try {
        simulate_segment(frame, asked);
    } catch (const Stopped&) {
        stopped = true;
        if (control_->segment().probes) drop_withheld();
        deliver_all(asked.finished);
        if (kept_) restore_kept();
        take_host_state(before);
    }
    in_segment_ = false;
    return !stopped;
}

void FrameLoop::simulate_segment(std::uint32_t frame, const Asked& asked) {
    if (sleep_.asleep(frame)) return sleep_through(frame, asked);
    before_ = attempt_statistics_.empty() ? starting_statistics(model_) : attempt_statistics_.back();
    const Segment& begun = control_->begin(probe_room(model_, frame), drive_.eventful(frame));
    if (begun.probes) drive_.probed(frame, begun.frame_count);
    if (begun.probes) deliver_all(asked.finished);  // then only withheld frames are in flight
    FrameEffort effort{.attempts = 0};
    Judged judged;
    for (;;) {
        const Attempt attempt{frame, effort.attempts + 1, !kept_};
        Judgement judgement;
        judgement.sensitive = sensitivity_.is_sensitive();
        fullest_ = {};
        if (control_->segment().probes) run_coarse(attempt, judgement, asked);
        judged = run_fine(attempt, judgement, asked);
        if (lengthen_lists()) continue;
        ++effort.attempts;
        const SubstepControl::Verdict verdict = control_->judge(judgement);
        if (verdict == SubstepControl::Verdict::give_up) give_up(frame, judgement, asked);
        effort.within_limits = verdict != SubstepControl::Verdict::give_up || !judgement.plausible;
        effort.predictable = verdict != SubstepControl::Verdict::unpredictable;
        if (verdict != SubstepControl::Verdict::again) break;
        if (control_->segment().probes) drop_withheld();
    }
    effort.substeps = control_->segment().substeps;
    if (control_->segment().probes) effort.motion_error = motion_error_;
    judged.effort = effort;
    keep_segment(frame, std::move(judged), asked);
}

/// `single` is the frame, unless the segment is a probe; its effort is the segment's.
void FrameLoop::keep_segment(std::uint32_t frame, Judged single, const Asked& asked) {
    const Segment& segment = control_->segment();
    for (const std::vector<ClothStatistics>& cloths : attempt_statistics_) sleep_.saw(cloths, segment.substeps);
    for (std::size_t k = 0; k < attempt_self_records_.size(); ++k)
        note_self_contact(frame + static_cast<std::uint32_t>(k), attempt_self_records_[k]);
    state_substeps_ = segment.substeps;
    simulated_ = frame + segment.frame_count;
    follow_segment(frame, single.effort.predictable, segment.probes ? withhold_ : asked.finished);
    note_motion(position_error_, sensitivity_, single.effort);
    // Frames behind the last that is asked for are withheld, for they may be wanted then.
    for (std::uint32_t k = 0; k < segment.frame_count && frame + k <= asked.last; ++k)
        if (!asked.wanted(frame + k)) pass_over(frame + k, attempt_statistics_[k], single.effort);
    if (!segment.probes)
        return submit_output(frame, std::move(single), frame > asked.last || asked.wanted(frame), asked.finished);
    deliver_all(withhold_);
    for (FrameCopy& copy : withheld_) copy.effort() = single.effort;
}

void FrameLoop::give_up(std::uint32_t frame, const Judgement& judgement, const Asked& asked) {
    control_->keep_anyway();
    // A frame that is not finite, or not plausible, is told of when it is handed out.
    if (!options_.keep_promises || !std::isfinite(judgement.excess()) || !judgement.plausible) return;
    if (!control_->segment().probes) deliver_all(asked.finished);
    const bool stretch = judgement.excess() > 1;
    const std::string impossible = impossible_scene(model_, frame + control_->segment().frame_count - 1);
    const char* criterion = stretch ? "stretch error" : "estimated error of the motion";
    const double times = stretch ? judgement.excess() : judgement.motion;
    const std::string text = fmt::format(
        "the tolerance is missed: from frame {} on the {} is {:.3g} times its limit even with {} substeps of method "
        "{}, the most that method auto tries{}{}",
        frame, criterion, times, control_->segment().substeps, model_.method().name, impossible.empty() ? "" : "; ",
        impossible);
    throw ToleranceMissed(text, FrameFailure{FrameFailure::Kind::tolerance, text, frame,
                                             fmt::format("{} over its limit", criterion), times, 1});
}

void FrameLoop::submit_output(std::uint32_t frame, Judged judged, bool wanted, const Finished& finished) {
    const bool cutting = !judged.effort.asleep && searched(frame);  // of what is asleep the last search holds
    if (!wanted && !cutting) return;
    const std::uint32_t slot = take_slot(finished);
    submit(slot, frame, !wanted ? FrameKind::search_cut : cutting ? FrameKind::output_cut : FrameKind::output, wanted);
    if (judged.effort.substeps > 0) in_flight_[slot]->substeps = judged.effort.substeps;  // a probe is not kept yet
    in_flight_[slot]->judged = std::move(judged);
    if (cutting) take_cuts_of(slot, frame, finished);
}

void FrameLoop::release_withheld(std::uint32_t frame, bool wanted, const Finished& finished) {
    if (withheld_.empty() || withheld_.front().frame().frame != frame) return;
    const FrameCopy copy = std::move(withheld_.front());
    withheld_.pop_front();
    if (wanted)
        finished(copy.frame());
    else
        pass_over(frame, copy.frame().statistics, copy.frame().effort);
}

void FrameLoop::pass_over(std::uint32_t frame, const std::vector<ClothStatistics>& statistics,
                          const FrameEffort& effort) {
    if (!options_.on_passed_over) return;
    FinishedFrame& passed = passed_over_.emplace_back();
    passed.frame = frame;
    passed.statistics = statistics;
    passed.effort = effort;
}

}  // namespace drape
