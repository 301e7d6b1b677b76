#include "twin/twin_loop.h"

#include <algorithm>
#include <array>

#include "cloth/difference.h"
#include "cloth/texels.h"
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
    : model_(model), pilot_(model), states_(state_set_count, Twin(model)) {}

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
        all.push_back(cloth_statistics(run, run.cloths[cloth], twin_statistics(run, cloth, twin.cloth(cloth), inputs),
                                       frame, std::as_bytes(std::span(twin.cloth(cloth).integers(Field::impulses)))));
    }
    return all;
}

std::vector<double> TwinLoop::differences(const Twin& fine, const Twin& coarse) const {
    std::vector<double> all;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
        all.push_back(
            difference_of(partial_differences(model_.cloths[cloth].grid, fine.cloth(cloth), coarse.cloth(cloth))));
    for (std::size_t cloth = 0; cloth < all.size(); ++cloth)
        if (has_bodies(model_, cloth))
            all[cloth] = difference_with_bodies(all[cloth], body_distances(fine.cloth(cloth), coarse.cloth(cloth)));
    return all;
}

void TwinLoop::do_step(StateStep step, const Work& work, WorkResult& result) {
    Twin& state = in(work.set);
    switch (step) {
        case StateStep::keep:
            kept_.insert_or_assign(work.set, state);
            break;
        case StateStep::restore:
            state = kept_.at(work.set);
            break;
        case StateStep::change_substep:
            state.change_substep(at(work.substeps));
            break;
        case StateStep::remember:
            remembered_ = state;
            break;
        case StateStep::compare:
            result.differences = differences(state, *remembered_);
            break;
        case StateStep::compare_companion:
            result.differences = differences(in(StateSet::run), in(StateSet::companion));
            break;
        case StateStep::disturb:
            in(StateSet::disturbed) = in(StateSet::companion);
            in(StateSet::disturbed).disturb();
            break;
        case StateStep::compare_disturbed:
            result.differences = differences(in(StateSet::companion), in(StateSet::disturbed));
            break;
    }
}

WorkResult TwinLoop::done(const Work& work) {
    WorkResult result;
    if (work.before) do_step(*work.before, work, result);
    if (work.changes_substeps()) do_step(StateStep::change_substep, work, result);
    if (work.simulates) {
        Twin& state = in(work.set);
        state.run_frame(work.frame);
        if (work.set == StateSet::run) result.statistics = statistics(state, work.frame, at(work.substeps));
        if (model_.self_contact) result.contact = state.contact().record;
    }
    if (work.after) do_step(*work.after, work, result);
    return result;
}

void TwinLoop::run(std::uint32_t last,
                   const std::function<void(std::uint32_t, const Twin&, const FrameEffort&)>& finished) {
    while (next_ <= last) {
        std::deque<Twin> handed_out;
        pilot_.begin();
        while (const std::optional<Work> work = pilot_.next_work()) {
            if (work->attempt > 0 && work->before) handed_out.clear();  // another attempt begins
            if (work->hands_out) handed_out.push_back(in(StateSet::run));
            if (!work->hands_out) pilot_.take(*work, done(*work));
        }
        for (; next_ < pilot_.simulated(); ++next_) {
            finished(next_, handed_out.front(), pilot_.kept()->effort);
            handed_out.pop_front();
        }
    }
}

}  // namespace drape
