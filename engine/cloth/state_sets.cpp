#include "cloth/state_sets.h"

namespace drape {

bool has_set(const SimulationModel& model, StateSet set) {
    if (set == StateSet::run) return true;
    if (set == StateSet::disturbed && !model.closed_loop()) return false;
    return model.has_companions();
}

std::vector<StateStep> state_steps(const SimulationModel& model, StateSet set) {
    using enum StateStep;
    const bool closed = model.closed_loop(), meets = model.self_contact.has_value(), is_run = set == StateSet::run;
    const auto has = [&](StateSet each) { return has_set(model, each); };
    if (!has(set)) return {};
    std::vector<StateStep> steps;
    if (!is_run || closed) steps.push_back(change_substep);
    // Frames are done again where contact's lists were too short, which requires the state at their start.
    if (meets || (is_run && closed)) steps.insert(steps.end(), {keep, restore});
    if (is_run && closed) steps.insert(steps.end(), {remember, compare});
    if (is_run && has(StateSet::disturbed)) steps.insert(steps.end(), {disturb, compare_disturbed});
    if (is_run && model.has_companions()) steps.push_back(compare_companion);
    return steps;
}

}  // namespace drape
