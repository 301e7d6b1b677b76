#include "control/auto_pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cloth/statistics_transfer.h"
#include "control/balance.h"
#include "control/impossible_scene.h"
#include "control/named_pilot.h"
#include "control/passage_watch.h"

namespace drape {

namespace {

std::uint32_t& history_in(Histories& histories, StateSet set) { return histories[static_cast<std::size_t>(set)]; }

/// Returns a step without a frame.
Work step_alone(std::uint32_t frame, StateStep step) {
    Work work;
    work.frame = frame;
    work.before = step;
    work.awaited = step == StateStep::compare_companion || step == StateStep::compare_disturbed;
    return work;
}

}  // namespace

std::unique_ptr<Pilot> make_pilot(const SimulationModel& model) {
    if (model.closed_loop()) return std::make_unique<AutoPilot>(model);
    return std::make_unique<NamedPilot>(model);
}

AutoPilot::AutoPilot(const SimulationModel& model)
    : model_(model),
      control_(row_of(model.scene.solver.method), model.scene.solver.substeps,
               {model.choice.least_substeps, model.choice.calm_substeps}, probe_length(model)),
      watch_(model),
      sleep_(model),
      drive_(model),
      stated_{MotionError(model), Sensitivity(model)} {
    histories_.fill(model.scene.solver.substeps);
}

void AutoPilot::begin() {
    ByteWriter writer;
    write(writer);
    begun_ = writer.take();
    attempt_ = {};
    kept_ = {.first = simulated_};
    if (sleep_.asleep(simulated_) && !stated_.sensitivity.undecided()) {
        attempt_.phase = Phase::asleep;
        return;
    }
    control_.begin(probe_room(model_, simulated_), drive_.eventful(simulated_));
    kept_.effort.attempts = 0;
    begin_attempt();
}

void AutoPilot::begin_attempt() {
    attempt_.phase = probes() ? Phase::coarse : Phase::fine;
    attempt_.next = 0;
    attempt_.judgement = {.sensitive = stated_.sensitivity.excuses()};
    kept_.statistics.clear();
    kept_.contacts.clear();
    kept_.list_use = 0;
}

void AutoPilot::attempt_anew() {
    attempt_.keeps = true;
    begin_attempt();
}

void AutoPilot::abandon(const Work& refused) {
    const bool moved = !attempt_.keeps && refused.before != StateStep::keep;
    ByteReader reader(begun_);
    read(reader);
    if (moved) attempt_.phase = Phase::restore;
}

Work AutoPilot::frame_in(StateSet set, std::uint32_t substeps) {
    Work work;
    work.frame = kept_.first + attempt_.next;
    work.set = set;
    work.simulates = true;
    work.substeps = substeps;
    work.history_substeps = attempt_.next == 0 ? history_in(histories_, set) : substeps;
    if (set == StateSet::run) work.attempt = kept_.effort.attempts + 1;
    if (set == StateSet::run && attempt_.next == 0)
        work.before = std::exchange(attempt_.keeps, false) ? StateStep::keep : StateStep::restore;
    work.awaited = set == StateSet::run;
    return work;
}

Work AutoPilot::attempted(std::uint32_t substeps, std::optional<StateStep> at_end) {
    Work work = frame_in(StateSet::run, substeps);
    if (is_last()) work.after = at_end;
    return work;
}

/// The pilot learns nothing from the statistics of the companion's and the disturbed run's frames; it compares their
/// positions with the run's.
Work AutoPilot::frame_beside(StateSet set) {
    Work work = frame_in(set, model_.companion_substeps(control_.segment().substeps));
    if (model_.self_contact)
        work.before = StateStep::keep;  // the frame is done again if contact's lists of pairs turn out too short
    history_in(histories_, set) = work.substeps;
    const bool last = is_last();
    ++attempt_.next;
    if (last) follow(set);
    return work;
}

Work AutoPilot::handed_out(std::uint32_t frame) const {
    Work work;
    work.frame = frame;
    work.hands_out = true;
    work.known = attempt_.last;
    work.known->withheld = probes();
    work.substeps = control_.segment().substeps;
    return work;
}

std::optional<Work> AutoPilot::next_work() {
    switch (attempt_.phase) {
        case Phase::done:
            return std::nullopt;
        case Phase::asleep: {
            // Nothing moves in a sleeping frame. The saved state keeps the velocity with which it fell asleep.
            KnownFrame still{before_, {.attempts = 0, .asleep = true}};
            note_motion(stated_.error, stated_.sensitivity, still.effort);
            for (ClothStatistics& cloth : still.statistics) {
                cloth.kinetic_energy = cloth.largest_speed = 0;
                cloth.momentum = cloth.angular_momentum = cloth.angular_error = {};
            }
            kept_.effort = still.effort;
            kept_.statistics = {still.statistics};
            ++simulated_;
            attempt_.phase = Phase::done;
            return Work{.frame = kept_.first,
                        .history_substeps = history_in(histories_, StateSet::run),
                        .hands_out = true,
                        .known = std::move(still)};
        }
        case Phase::coarse:
            return attempted(control_.segment().substeps / 2, StateStep::remember);
        case Phase::fine:
            return attempted(control_.segment().substeps, probes() ? std::optional(StateStep::compare) : std::nullopt);
        case Phase::hand_out:
            attempt_.phase = Phase::fine;
            return handed_out(kept_.first + attempt_.next++);
        case Phase::companion:
            return frame_beside(StateSet::companion);
        case Phase::disturbed:
            return frame_beside(StateSet::disturbed);
        case Phase::compare_companion:
            return step_alone(kept_.first, StateStep::compare_companion);
        case Phase::compare_disturbed:
            return step_alone(kept_.first, StateStep::compare_disturbed);
        case Phase::disturb:
            history_in(histories_, StateSet::disturbed) = history_in(histories_, StateSet::companion);
            finish();
            return step_alone(kept_.first, StateStep::disturb);
        case Phase::finish: {
            attempt_.phase = Phase::done;
            return handed_out(simulated_ - 1);
        }
        case Phase::restore:
            attempt_.phase = Phase::done;
            return step_alone(kept_.first, StateStep::restore);
    }
    return std::nullopt;
}

FrameEffort AutoPilot::take(const Work& work, const WorkResult& result) {
    if (!work.awaited) return {};
    if (!work.simulates)
        take_differences(*work.before, result.differences);
    else if (attempt_.phase == Phase::coarse)
        take_coarse(result);
    else
        take_fine(work, result);
    return {};
}

void AutoPilot::take_coarse(const WorkResult& result) {
    double& worst = attempt_.judgement.coarse_stretch;
    worst = std::max(worst, stretch_judgement(model_, result.statistics));
    const bool last = is_last();
    attempt_.next = last ? 0 : attempt_.next + 1;
    if (last) attempt_.phase = Phase::fine;
}

/// Judges a frame. One that fails ends its attempt, so that the others need not be run.
void AutoPilot::take_fine(const Work& work, const WorkResult& result) {
    Judgement& judgement = attempt_.judgement;
    const std::vector<ClothStatistics> start = before_.empty() ? starting_statistics(model_) : before_;
    judgement.passage = std::max(
        judgement.passage, passage_judgement(model_, work.frame, work.substeps,
                                             attempt_.next == 0 ? start : kept_.statistics.back(), result.statistics));
    if (model_.self_contact) judgement.lag = std::max(judgement.lag, lag_judgement(model_, result.contact));
    judgement.lag = std::max(judgement.lag, turning_judgement(model_, result.statistics));
    kept_.statistics.push_back(result.statistics);
    kept_.contacts.push_back(result.contact);
    kept_.list_use = std::max(kept_.list_use, result.list_use);
    attempt_.last = {result.statistics, {.substeps = work.substeps}, result.timings};
    const double implausible = std::max(watch_.excess(work.frame, result.statistics), result.list_use);
    judgement.plausible = judgement.plausible && implausible <= 1;
    judgement.stretch = std::max(judgement.stretch, stretch_judgement(model_, result.statistics));
    judgement.watch = std::max(judgement.watch, implausible);
    if (control_.fails(judgement)) return conclude();
    if (!is_last()) {
        attempt_.phase = Phase::hand_out;
        return;
    }
    if (probes()) judgement.motion = motion_of(result.differences);
    conclude();
}

/// Returns the estimated error of the worst cloth's motion, divided by its limit.
double AutoPilot::motion_of(std::span<const double> differences) {
    FrameEffort& effort = kept_.effort;
    double worst = 0;
    for (std::size_t cloth = 0; cloth < differences.size(); ++cloth) {
        const double error = motion_error(model_, differences[cloth], control_.segment().frame_count);
        const double allowed = motion_limit(model_, cloth);
        if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
        if (cloth > 0 && error / allowed <= worst) continue;
        worst = error / allowed;
        effort.motion_error = error;
        effort.motion_allowed = allowed;
    }
    return worst;
}

void AutoPilot::conclude() {
    using Verdict = SubstepControl::Verdict;
    FrameEffort& effort = kept_.effort;
    ++effort.attempts;
    const FailedAttempt failed = control_.failure(attempt_.judgement);
    const Verdict verdict = control_.judge(attempt_.judgement);
    if (verdict == Verdict::again) {
        effort.failed.push_back(failed);
        return begin_attempt();
    }
    if (verdict == Verdict::give_up) refuse();
    effort.within_limits = verdict != Verdict::give_up || !attempt_.judgement.plausible;
    effort.predictable = verdict != Verdict::unpredictable;
    keep();
}

/// Explains why the limits are missed. A frame that is not finite or not plausible is reported when it is handed out.
void AutoPilot::refuse() {
    const Segment segment = control_.segment();
    const Judgement& judgement = attempt_.judgement;
    control_.keep_anyway();
    if (!std::isfinite(judgement.excess()) || !judgement.plausible) return;
    const bool stretch = judgement.excess() > 1;
    const std::string impossible = impossible_scene(model_, kept_.first + segment.frame_count - 1);
    const char* criterion = stretch ? "stretch error" : "estimated error of the motion";
    const double times = stretch ? judgement.excess() : judgement.motion;
    const std::string text = fmt::format(
        "the tolerance is missed: from frame {} on the {} is {:.3g} times its limit even with {} substeps of method "
        "{}, the most that method auto tries{}{}",
        kept_.first, criterion, times, segment.substeps, model_.method().name, impossible.empty() ? "" : "; ",
        impossible);
    attempt_.refusal = FrameFailure{
        FrameFailure::Kind::tolerance, text, kept_.first, fmt::format("{} over its limit", criterion), times, 1};
}

void AutoPilot::keep() {
    const Segment& segment = control_.segment();
    if (segment.probes) drive_.probed(kept_.first, segment.frame_count);
    for (const std::vector<ClothStatistics>& cloths : kept_.statistics) sleep_.saw(cloths, segment.substeps);
    before_ = kept_.statistics.back();
    history_in(histories_, StateSet::run) = segment.substeps;
    kept_.effort.substeps = segment.substeps;
    simulated_ = kept_.first + segment.frame_count;
    attempt_.next = 0;
    if (!model_.has_companions()) {
        control_.accumulated({});
        return finish();
    }
    if (stated_.sensitivity.is_lost()) {  // no error of positions is stated any more
        control_.accumulated({.share = 0});
        return finish();
    }
    attempt_.phase = Phase::companion;
}

void AutoPilot::follow(StateSet done) {
    attempt_.next = 0;
    if (done == StateSet::companion && stated_.sensitivity.runs())
        attempt_.phase = Phase::disturbed;
    else if (compares_at(model_, simulated_ - 1, probes()))
        attempt_.phase = Phase::compare_companion;
    else
        finish();
}

void AutoPilot::take_differences(StateStep step, std::span<const double> differences) {
    auto& [error, sensitivity] = stated_;
    const std::uint32_t last = simulated_ - 1;
    const bool is_first = std::isnan(error.error());
    if (step == StateStep::compare_companion) {
        error.saw(last, control_.segment().substeps, differences);
        if (sensitivity.runs()) {
            attempt_.phase = Phase::compare_disturbed;
            return;
        }
    } else {
        sensitivity.saw(last, differences, error);
    }
    const bool begins =
        sensitivity.begins(last, error, kept_.effort.predictable) || (is_first && starts_in_balance(model_));
    if (begins) sensitivity.begin(last);
    if (sensitivity.excuses())
        control_.accumulated({.share = 0});
    else if (!sleep_.is_still())
        control_.accumulated({error.share(), error.growth()});
    if (begins)
        attempt_.phase = Phase::disturb;
    else
        finish();
}

void AutoPilot::finish() {
    note_motion(stated_.error, stated_.sensitivity, kept_.effort);
    attempt_.last.effort = kept_.effort;
    attempt_.phase = Phase::finish;
}

template <class Archive>
bool AutoPilot::transfer(Archive& archive) {
    archive(histories_[0], simulated_, histories_[1], histories_[2]);
    stated_.sensitivity.transfer(archive);
    if (!stated_.error.transfer(archive)) throw Error("not as many cloths that have errors");
    if (!control_.transfer(archive)) throw Error("no such substeps");
    if (!sleep_.transfer(archive)) throw Error("more speeds than are remembered");
    if (!drive_.transfer(archive)) throw Error("not as many cloths that are driven");
    bool has_statistics = !before_.empty();
    archive(has_statistics);
    before_.resize(has_statistics ? model_.cloths.size() : 0);
    for (ClothStatistics& statistics : before_) transfer_statistics(archive, statistics);
    const auto rungs = substep_rungs(row_of(model_.scene.solver.method));
    const bool history_can_be =
        histories_[0] == model_.scene.solver.substeps || std::ranges::count(rungs, histories_[0]) == 1;
    // A sleeping frame repeats the statistics of the frame before it.
    return history_can_be && std::ranges::count(histories_, 0u) == 0 && (!sleep_.remembers() || has_statistics);
}

void AutoPilot::write(ByteWriter& writer) const { const_cast<AutoPilot*>(this)->transfer(writer); }

void AutoPilot::read(ByteReader& reader) {
    attempt_ = {};
    if (!transfer(reader)) throw Error("its part 'loop' is of something else");
}

}  // namespace drape
