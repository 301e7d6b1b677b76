// A frame loop submits to a device of its own, or to its lane, where other loops' submits go along.
#include <cstring>

#include "simulation/frame_loop.h"

namespace drape {

bool has_set(const SimulationModel& model, StateSet set) {
    if (set == StateSet::run) return true;
    if (set == StateSet::disturbed && !model.closed_loop()) return false;
    return model.has_companions();
}

std::vector<AttemptStep> attempt_steps(const SimulationModel& model, StateSet set) {
    using enum AttemptStep;
    const bool closed = model.closed_loop(), meets = model.self_contact.has_value(), is_run = set == StateSet::run;
    const auto has = [&](StateSet each) { return has_set(model, each); };
    if (!has(set)) return {};
    std::vector<AttemptStep> steps;
    if (!is_run || closed) steps.push_back(change_substep);
    // Lists of contact may be too short.
    if (meets || (is_run && closed)) steps.insert(steps.end(), {keep, restore});
    if (is_run && closed) steps.insert(steps.end(), {remember, compare});
    if (is_run && has(StateSet::disturbed)) steps.insert(steps.end(), {disturb, compare_disturbed});
    if (is_run && model.has_companions()) steps.push_back(compare_companion);
    return steps;
}

FrameLoop::Rung& FrameLoop::rung(std::uint32_t substeps, StateSet set) {
    Rung& rung = rungs_[static_cast<std::size_t>(set)][substeps];
    if (!rung.model) rung.model = std::make_unique<SimulationModel>(model_, substeps);
    if (rung.frame.recorded || options_.lane) return rung;
    rung.frame = set == StateSet::run ? build(FrameKind::simulate, *rung.model) : build_beside(*rung.model, set);
    rung.frame.recorded = recording(rung.frame);
    return rung;
}

VkCommandBuffer FrameLoop::commands_of(const LanePart& part, std::uint32_t slot) {
    if (part.kind == LanePart::Kind::attempt) return commands(part.step, slot, part.set);
    return rung(part.substeps, part.set).frame.recorded->commands(slot);
}

void FrameLoop::submit_parts(std::uint32_t slot, const LaneWork& work) {
    if (options_.lane) return options_.lane->submit(slot, work);
    std::vector<VkCommandBuffer> all;
    for (const LanePart& part : work.parts) all.push_back(commands_of(part, slot));
    if (!work.changes.empty()) solver_.write_changes(*pool_, slot, work.changes);
    if (work.run) solver_.write_inputs(*pool_, slot, work.frame, *work.run);
    slots_.submit(slot, all);
}

/// A closed loop hands out frames that it has simulated before.
void FrameLoop::submit_in_lane(std::uint32_t slot, std::uint32_t frame, FrameKind kind, bool output) {
    LaneWork work{.parts = {{needs(kind).statistics ? LanePart::Kind::statistics : LanePart::Kind::look}},
                  .frame = frame,
                  .run = &model_};
    options_.lane->submit(slot, work);
    in_flight_[slot] = InFlight{frame, kind, output, state_substeps_, std::nullopt};
}

void FrameLoop::wait(std::uint32_t slot) {
    if (!options_.lane) slots_.wait(slot);
}

std::vector<ClothStatistics> FrameLoop::statistics_in(std::uint32_t slot, std::uint32_t frame,
                                                      const SimulationModel& run) const {
    if (!options_.lane) return solver_.statistics(*pool_, slot, frame, run);
    std::vector<ClothStatistics> all;
    const LaneResult& result = options_.lane->result(slot);
    for (std::size_t cloth = 0; cloth < run.cloths.size(); ++cloth)
        all.push_back(cloth_statistics(run, run.cloths[cloth], result.statistics[cloth], frame));
    return all;
}

std::vector<double> FrameLoop::differences_in(std::uint32_t slot) const {
    return options_.lane ? options_.lane->result(slot).differences : solver_.differences(*pool_, slot);
}

glsl::SelfRecord FrameLoop::self_record_in(std::uint32_t slot) const {
    return options_.lane ? glsl::SelfRecord{} : solver_.self_record(*pool_, slot);
}

std::vector<std::span<const float>> FrameLoop::array_in(std::uint32_t slot, std::string_view what) const {
    if (!options_.lane) return solver_.readback(*pool_, slot, what);
    const auto found = options_.lane->result(slot).arrays.find(what);
    return {found->second.begin(), found->second.end()};
}

SimulationState FrameLoop::device_state() const {
    return options_.lane ? options_.lane->download() : solver_.download_state(*pool_);
}

}  // namespace drape
