#include "twin_steps.h"

#include <algorithm>
#include <stdexcept>

namespace drape::test {

TwinSteps::TwinSteps(std::vector<Step> steps, std::size_t cloth_count) : lanes_(cloth_count + 1) {
    for (Step& step : steps) lanes_[std::min(step.cloth, cloth_count)].steps.push_back(std::move(step));
}

std::size_t TwinSteps::end_of(const Lane& lane, const Step& step) {
    const auto is_like = [&](const Step& plain, StepKind kind, std::uint32_t first, std::uint32_t count) {
        return plain.kind == kind && plain.substep >= first && plain.substep < first + count &&
               plain.iteration == step.iteration;
    };
    std::size_t end = lane.next;
    for (std::size_t k = lane.next, found = 0; k < lane.steps.size() && found < step.count; ++k)
        if (is_like(lane.steps[k], step.kind, step.substep, step.count)) {
            end = k + 1;
            ++found;
        }
    if (end > lane.next || lane.next == lane.steps.size()) return end;
    const StepKind joined = lane.steps[lane.next].kind;
    while (end < lane.steps.size() && is_like(lane.steps[end], joined, step.substep, 1)) ++end;
    return end;
}

void TwinSteps::take(Twin& twin, const FrameInputs& inputs, const Step& step, const std::vector<std::size_t>& cloths) {
    const auto take_from = [&](Lane& lane) {
        const std::size_t end = end_of(lane, step);
        if (end == lane.next) throw std::logic_error("the twin has no such step");
        for (; lane.next < end; ++lane.next) twin.run_step(lane.steps[lane.next], inputs);
    };
    if (step.cloth >= lanes_.size() - 1) return take_from(lanes_.back());
    for (const std::size_t cloth : cloths) take_from(lanes_[cloth]);
}

bool TwinSteps::done() const {
    return std::ranges::all_of(lanes_, [](const Lane& lane) { return lane.next == lane.steps.size(); });
}

}  // namespace drape::test
