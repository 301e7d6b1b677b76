#include "cloth/streams.h"

#include <algorithm>
#include <functional>
#include <map>

#include "cloth/schedule.h"
#include "shared/stream_types.h"
#include "shared/tile_types.h"

namespace drape {

namespace {

/// No frame's first step, for that finds other positions (Step::substep); no last one (steps_in_flight); none that
/// bends.
bool can_fly(const Step& step) {
    return step.kind == StepKind::explicit_step && step.substep > 0 && !step.last &&
           step.push<glsl::ExplicitPush>().twist == 0;
}

/// Where the steps of a cloth from `first` on are, as long as nothing else happens to it between them and they are no
/// more than may be; nothing where they are too few.
std::vector<std::size_t> run_of(const std::vector<Step>& steps, std::size_t first, const FlightSize& size) {
    std::vector<std::size_t> places;
    for (std::size_t k = first; k < steps.size() && places.size() < size.most; ++k) {
        if (steps[k].cloth != steps[first].cloth && steps[k].cloth != all_cloths) continue;
        if (!can_fly(steps[k])) break;
        places.push_back(k);
    }
    return places.size() >= size.least ? places : std::vector<std::size_t>{};
}

/// Finds the passes that sweeps can do, and makes sweeps of them.
class SweepMaker {
  public:
    SweepMaker(const SimulationModel& model, const std::vector<Step>& steps) : model_(model), steps_(steps) {}

    /// How many steps from `first` on one sweep does, which are all springs of an iteration; 0: it does not. Not those
    /// that the device may leave out, nor those of a cloth where springs of some directions only carry tension.
    std::size_t length_at(std::size_t first) const {
        const Step& step = steps_[first];
        if (step.kind != StepKind::spring || step.conditional) return 0;
        const PerDirection<bool>& carries = model_.cloths[step.cloth].plan.carries_tension;
        if (std::ranges::any_of(carries, std::identity()) && !std::ranges::all_of(carries, std::identity())) return 0;
        std::size_t end = first;
        while (end < steps_.size() && same_iteration(steps_[end], step)) ++end;
        return end - first;
    }

    Step made_of(std::size_t first, std::size_t length) const {
        Step sweep = steps_[first];
        sweep.kind = StepKind::sweep;
        glsl::SweepPush push{};
        for (std::size_t k = first; k < first + length; ++k) {
            const auto& spring = steps_[k].push<glsl::SpringPush>();
            push.grid = spring.grid;
            push.compression = spring.compression;
            put(push.rest_length, spring.channel, spring.rest_length);
            put(push.compliance, spring.channel, spring.compliance);
        }
        sweep.constants = push;
        return sweep;
    }

  private:
    static void put(glsl::vec4& values, int channel, float value) {
        float* const places[] = {&values.x, &values.y, &values.z, &values.w};
        *places[channel] = value;
    }
    static bool same_iteration(const Step& one, const Step& other) {
        return one.kind == other.kind && one.cloth == other.cloth && one.substep == other.substep &&
               one.iteration == other.iteration;
    }
    const SimulationModel& model_;
    const std::vector<Step>& steps_;
};

/// Steps of which some are sweeps. A sweep writes the other image of the displacement, so that a prediction does too
/// before an odd number of them; and one of springs the other images of the tension, so that the substep's last one
/// writes those where it is looked for.
class SweptSteps {
  public:
    void add(const Step& step) {
        if (step.kind == StepKind::force || step.kind == StepKind::predict) substeps_[step.cloth] = {steps_.size(), {}};
        steps_.push_back(step);
    }
    void add_sweep(const Step& step) {
        Substep& substep = substeps_.at(step.cloth);
        steps_[substep.prediction].turns ^= true;
        if (step.kind == StepKind::sweep) {
            for (const std::size_t place : substep.sweeps) steps_[place].turns ^= true;
            substep.sweeps.push_back(steps_.size());
        }
        steps_.push_back(step);
    }
    const std::vector<Step>& steps() const { return steps_; }

  private:
    /// Places of steps.
    struct Substep {
        std::size_t prediction = 0;
        std::vector<std::size_t> sweeps;  // of springs
    };
    std::vector<Step> steps_;
    std::map<std::size_t, Substep> substeps_;  // by cloth: the last one
};

}  // namespace

std::vector<Step> steps_in_flight(const std::vector<Step>& steps,
                                  const std::function<FlightSize(std::size_t cloth)>& size) {
    std::vector<bool> taken(steps.size());
    std::vector<Step> merged;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (taken[k]) continue;
        merged.push_back(steps[k]);
        if (steps[k].kind != StepKind::explicit_step) continue;
        const std::vector<std::size_t> together = run_of(steps, k, size(steps[k].cloth));
        if (together.empty()) continue;
        merged.back().count = static_cast<std::uint32_t>(together.size());
        for (const std::size_t place : together) taken[place] = true;
    }
    return merged;
}

std::vector<Step> steps_in_sweeps(const SimulationModel& model, const std::vector<Step>& steps) {
    const SweepMaker maker(model, steps);
    SweptSteps swept;
    for (std::size_t k = 0; k < steps.size();) {
        const std::size_t length = maker.length_at(k);
        if (length > 0)
            swept.add_sweep(maker.made_of(k, length));
        else
            swept.add(steps[k]);
        k += std::max<std::size_t>(length, 1);
    }
    return swept.steps();
}

std::vector<Step> twists_in_sweeps(const std::vector<Step>& steps) {
    SweptSteps swept;
    for (const Step& step : steps) {
        const auto is_same = [&step](const Step& other) {
            return other.kind == StepKind::twist_sweep && other.cloth == step.cloth && other.substep == step.substep;
        };
        if (step.kind != StepKind::twist) {
            swept.add(step);
        } else if (!is_same(swept.steps().back())) {
            const auto& push = step.push<glsl::TwistPush>();
            Step sweep = step;
            sweep.kind = StepKind::twist_sweep;
            sweep.constants = glsl::TwistSweepPush{push.grid, push.compliance, push.compliance_bdf2};
            swept.add_sweep(sweep);
        }
    }
    return swept.steps();
}

bool has_direction(const glsl::SweepPush& push, int direction) {
    const float lengths[] = {push.rest_length.x, push.rest_length.y, push.rest_length.z, push.rest_length.w};
    return lengths[direction] > 0;
}

std::vector<Step> streamed_steps(const SimulationModel& model) {
    const auto streamed = [](std::size_t) { return FlightSize{glsl::stream_steps, glsl::stream_steps}; };
    std::vector<Step> steps = twists_in_sweeps(steps_in_sweeps(model, steps_in_flight(frame_steps(model), streamed)));
    for (Step& step : steps)
        step.streams = step.kind == StepKind::explicit_step && step.push<glsl::ExplicitPush>().twist == 0;
    return steps;
}

std::uint32_t tile_halo_of(const Grid& grid, int halo) {
    const bool is_whole = grid.columns() <= glsl::tile_width && grid.rows() <= glsl::tile_width;
    return is_whole ? 0 : static_cast<std::uint32_t>(halo);
}

std::uint32_t tile_invocations(std::uint32_t particles, std::uint32_t halo) {
    const std::uint32_t own = glsl::tile_width - 2 * halo;
    return (particles + own - 1) / own * glsl::tile_width;
}

std::vector<Step> tiled_steps(const SimulationModel& model) {
    const auto size = [&](std::size_t cloth) {
        const bool is_whole = tile_halo_of(model.cloths[cloth].grid, glsl::tile_halo) == 0;
        return FlightSize{2, static_cast<std::uint32_t>(is_whole ? glsl::tile_most_steps : glsl::tile_halo)};
    };
    return steps_in_sweeps(model, steps_in_flight(frame_steps(model), size));
}

}  // namespace drape
