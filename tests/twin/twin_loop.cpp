#include "twin/twin_loop.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cloth/difference.h"
#include "cloth/texels.h"
#include "control/passage_watch.h"
#include "twin/kernels.h"
#include "twin/statistics.h"

namespace drape {

using namespace glsl;

namespace {

/// Joins the differences in the order of the workgroups of difference.comp. Returns a record per workgroup.
std::vector<DifferenceRecord> partial_differences(const Grid& grid, const TwinCloth& fine, const TwinCloth& coarse) {
    std::vector<DifferenceRecord> partials;
    const ivec2 size = grid.size();
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * grid.columns() + static_cast<std::size_t>(x);
    };
    for (int y = 0; y < size.y; y += difference_rows)
        for (int x = 0; x < size.x; x += workgroup_width) {
            std::array<DifferenceRecord, workgroup_width> lanes;
            lanes.fill(empty_difference());
            for (int lane = 0; lane < workgroup_width && x + lane < size.x; ++lane)
                for (int row = y; row < y + difference_rows && row < size.y; ++row) {
                    const vec4 at = fine[Field::position][index(x + lane, row)];
                    DifferenceRecord& record = lanes[static_cast<std::size_t>(lane)];
                    record = joined(
                        record, particle_difference(at.w, xyz(at), xyz(coarse[Field::position][index(x + lane, row)])));
                }
            for (std::size_t stride = workgroup_width / 2; stride > 0; stride /= 2)
                for (std::size_t lane = 0; lane < stride; ++lane)
                    lanes[lane] = joined(lanes[lane], lanes[lane + stride]);
            partials.push_back(lanes[0]);
        }
    return partials;
}

}  // namespace

TwinLoop::TwinLoop(const SimulationModel& model)
    : model_(model),
      control_(row_of(model.scene.solver.method), model.scene.solver.substeps, model.choice.least_substeps,
               probe_length(model)),
      watch_(model),
      sleep_(model),
      drive_(model),
      state_(model),
      state_substeps_(model.scene.solver.substeps),
      companion_{state_, state_substeps_},
      disturbed_(companion_),
      position_error_(model),
      sensitivity_(model) {}

const SimulationModel& TwinLoop::at(std::uint32_t substeps) {
    std::unique_ptr<SimulationModel>& run = runs_[substeps];
    if (!run) run = std::make_unique<SimulationModel>(model_, substeps);
    return *run;
}

std::vector<ClothStatistics> TwinLoop::statistics(Twin& twin, std::uint32_t frame, const SimulationModel& run) const {
    const FrameInputs inputs = frame_inputs(run, frame);
    std::vector<ClothStatistics> all;
    for (std::size_t cloth = 0; cloth < run.cloths.size(); ++cloth) {
        if (run.cloths[cloth].scheme.gathered_tension) twin.tension(cloth);
        all.push_back(
            cloth_statistics(run, run.cloths[cloth], twin_statistics(run, cloth, twin.cloth(cloth), inputs), frame));
    }
    return all;
}

std::vector<double> TwinLoop::differences(const Twin& fine, const Twin& coarse) const {
    std::vector<double> all;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
        all.push_back(
            difference_of(partial_differences(model_.cloths[cloth].grid, fine.cloth(cloth), coarse.cloth(cloth))));
    return all;
}

/// Simulates the kept segment's frames, which begin with the next one, in another twin.
void TwinLoop::follow(Beside& beside, std::uint32_t substeps) {
    if (substeps != beside.substeps) beside.twin.change_substep(at(substeps));
    beside.substeps = substeps;
    for (std::uint32_t k = 0; k < control_.segment().frame_count; ++k) beside.twin.run_frame(next_ + k);
}

void TwinLoop::follow_segment(const Twin& end, FrameEffort& effort) {
    if (!model_.has_companions()) return control_.accumulated(unknown_share);
    if (sensitivity_.is_sensitive()) return note_motion(position_error_, sensitivity_, effort);
    const Segment& segment = control_.segment();
    const std::uint32_t last = next_ + segment.frame_count - 1;
    const std::uint32_t beside = model_.companion_substeps(segment.substeps);
    follow(companion_, beside);
    if (sensitivity_.runs()) follow(disturbed_, beside);
    if (!compares_at(model_, last, segment.probes)) return note_motion(position_error_, sensitivity_, effort);
    position_error_.saw(last, segment.substeps, differences(end, companion_.twin));
    if (sensitivity_.runs()) sensitivity_.saw(last, differences(companion_.twin, disturbed_.twin), position_error_);
    if (sensitivity_.begins(last, position_error_, effort.predictable)) {
        sensitivity_.begin(last);
        disturbed_ = companion_;
        disturbed_.twin.disturb();
    }
    control_.accumulated(sensitivity_.is_sensitive() ? 0 : position_error_.share());
    note_motion(position_error_, sensitivity_, effort);
}

double TwinLoop::motion(const Twin& fine, const Twin& coarse) {
    double worst = motion_error_ = 0;
    const std::vector<double> apart = differences(fine, coarse);
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const double error = motion_error(model_, apart[cloth], control_.segment().frame_count);
        if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, error / motion_limit(model_, cloth));
        motion_error_ = std::max(motion_error_, error);
    }
    return worst;
}

Judgement TwinLoop::attempt(std::uint32_t frame, std::vector<Twin>& frames) {
    const Segment& segment = control_.segment();
    Judgement judgement;
    judgement.sensitive = sensitivity_.is_sensitive();
    const auto begin = [&](std::uint32_t substeps) {
        Twin twin = state_;
        if (substeps != state_substeps_) twin.change_substep(at(substeps));
        return twin;
    };
    const auto run = [&](Twin& twin, std::uint32_t k, std::uint32_t substeps) {
        twin.run_frame(frame + k);
        attempt_statistics_.push_back(statistics(twin, frame + k, at(substeps)));
        return stretch_judgement(model_, attempt_statistics_.back());
    };
    Twin coarse = begin(segment.probes ? segment.substeps / 2 : segment.substeps), fine = begin(segment.substeps);
    for (std::uint32_t k = 0; segment.probes && k < segment.frame_count; ++k)
        judgement.coarse_stretch = std::max(judgement.coarse_stretch, run(coarse, k, segment.substeps / 2));
    attempt_statistics_.clear();  // the coarse run's are of no use
    for (std::uint32_t k = 0; k < segment.frame_count; ++k) {
        const double stretch = run(fine, k, segment.substeps);
        const std::vector<ClothStatistics>& found = attempt_statistics_.back();
        const double implausible = watch_.excess(frame + k, found);
        judgement.passage =
            std::max(judgement.passage, passage_judgement(model_, frame + k, segment.substeps,
                                                          k == 0 ? before_ : attempt_statistics_[k - 1], found));
        if (model_.self_contact) judgement.lag = std::max(judgement.lag, lag_judgement(model_, fine.contact().record));
        judgement.plausible = judgement.plausible && implausible <= 1;
        judgement.stretch = std::max(judgement.stretch, stretch);
        judgement.watch = std::max(judgement.watch, implausible);
        if (control_.fails(judgement)) return judgement;
        frames.push_back(fine);
    }
    if (segment.probes) judgement.motion = motion(fine, coarse);
    return judgement;
}

void TwinLoop::run(std::uint32_t last,
                   const std::function<void(std::uint32_t, const Twin&, const FrameEffort&)>& finished) {
    using Verdict = SubstepControl::Verdict;
    while (next_ <= last) {
        if (sleep_.asleep(next_)) {
            FrameEffort asleep{.attempts = 0, .asleep = true};
            note_motion(position_error_, sensitivity_, asleep);
            finished(next_++, state_, asleep);
            continue;
        }
        before_ = attempt_statistics_.empty() ? starting_statistics(model_) : attempt_statistics_.back();
        control_.begin(probe_room(model_, next_), drive_.eventful(next_));
        if (control_.segment().probes) drive_.probed(next_, control_.segment().frame_count);
        FrameEffort effort{.attempts = 0};
        std::vector<Twin> frames;
        for (Verdict verdict = Verdict::again; verdict == Verdict::again;) {
            frames.clear();
            ++effort.attempts;
            verdict = control_.judge(attempt(next_, frames));
            effort.predictable = verdict != Verdict::unpredictable;
            if (verdict == Verdict::give_up) control_.keep_anyway();
        }
        effort.substeps = state_substeps_ = control_.segment().substeps;
        if (control_.segment().probes) effort.motion_error = motion_error_;
        for (const std::vector<ClothStatistics>& cloths : attempt_statistics_) sleep_.saw(cloths, state_substeps_);
        state_ = frames.back();
        follow_segment(state_, effort);
        for (const Twin& twin : frames) finished(next_++, twin, effort);
    }
}

}  // namespace drape
