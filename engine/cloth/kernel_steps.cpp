#include "cloth/kernel_steps.h"

#include <algorithm>
#include <functional>
#include <map>

#include "cloth/cyclic_lines.h"
#include "cloth/frame_steps.h"
#include "shared/parts_types.h"
#include "shared/stream_types.h"
#include "shared/tile_types.h"

namespace drape {

namespace {

/// A frame's first step stays alone, since it takes other positions (Step::substep).
bool can_join(const Step& step) {
    return step.kind == StepKind::explicit_step && step.substep > 0 && !step.last &&
           step.push<glsl::ExplicitPush>().twist == 0;
}

/// Returns the places of consecutive steps of a cloth from `first` on, between which nothing else happens to it, up to
/// the largest number allowed; nothing if there are too few.
std::vector<std::size_t> run_of(const std::vector<Step>& steps, std::size_t first, const FlightSize& size) {
    std::vector<std::size_t> places;
    for (std::size_t k = first; k < steps.size() && places.size() < size.most; ++k) {
        if (steps[k].cloth != steps[first].cloth && steps[k].cloth != all_cloths) continue;
        if (!can_join(steps[k])) break;
        places.push_back(k);
    }
    return places.size() >= size.least ? places : std::vector<std::size_t>{};
}

/// Finds the plain steps that one step of all springs replaces.
class SpringJoiner {
  public:
    SpringJoiner(const SimulationModel& model, Kernel kernel, const std::vector<Step>& steps)
        : model_(model), kernel_(kernel), steps_(steps) {}

    /// Returns how many steps from `first` on, all springs of an iteration, one step can replace; 0: none.
    std::size_t length_at(std::size_t first) const {
        const Step& step = steps_[first];
        if (step.kind != StepKind::spring || step.conditional) return 0;
        const PerDirection<bool>& carries = model_.cloths[step.cloth].scheme.carries_tension;
        if (std::ranges::any_of(carries, std::identity()) && !std::ranges::all_of(carries, std::identity())) return 0;
        std::size_t end = first;
        while (end < steps_.size() && same_iteration(steps_[end], step)) ++end;
        return end - first;
    }

    Step made_of(std::size_t first, std::size_t length) const {
        Step joined = steps_[first];
        joined.kind = StepKind::all_springs;
        joined.kernel = kernel_;
        glsl::AllSpringsPush push{};
        for (std::size_t k = first; k < first + length; ++k) {
            const auto& spring = steps_[k].push<glsl::SpringPush>();
            push.grid = spring.grid;
            push.compression = spring.compression;
            put(push.rest_length, spring.channel, spring.rest_length);
            put(push.compliance, spring.channel, spring.compliance);
        }
        joined.constants = push;
        return joined;
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
    Kernel kernel_;
    const std::vector<Step>& steps_;
};

/// Counts the joined steps of a substep, which write the spare displacement: before an odd number of them the
/// prediction writes it too. Steps of all springs also write the spare tensions, so the last one of a substep must
/// write the tension to where it is read later.
class JoinedSteps {
  public:
    void add(const Step& step) {
        if (step.kind == StepKind::force || step.kind == StepKind::predict) substeps_[step.cloth] = {steps_.size(), {}};
        steps_.push_back(step);
    }
    void add_joined(const Step& step) {
        Substep& substep = substeps_.at(step.cloth);
        steps_[substep.prediction].turns ^= true;
        if (step.kind == StepKind::all_springs) {
            for (const std::size_t place : substep.springs) steps_[place].turns ^= true;
            substep.springs.push_back(steps_.size());
        }
        steps_.push_back(step);
    }
    const std::vector<Step>& steps() const { return steps_; }

  private:
    /// The places of a substep's steps.
    struct Substep {
        std::size_t prediction = 0;
        std::vector<std::size_t> springs;
    };
    std::vector<Step> steps_;
    std::map<std::size_t, Substep> substeps_;  ///< by cloth, its last substep
};

/// Returns how many explicit steps a tile takes at once: more of them where it holds the whole cloth.
FlightSize tile_flight(const Grid& grid) {
    const std::uint32_t halo = tile_of(StepKind::explicit_step, grid).halo;
    return {2, halo == 0 ? std::uint32_t{glsl::tile_most_steps} : halo};
}

/// Explicit steps that stay alone use the streaming kernel too, unless wind blows or the cloth bends.
void stream_single_steps(const SimulationModel& model, std::vector<Step>& steps) {
    for (Step& step : steps)
        if (step.kind == StepKind::explicit_step && !model.windy && step.push<glsl::ExplicitPush>().twist == 0)
            step.kernel = Kernel::explicit_stream;
}

/// Long lines are solved in parts, the others by cyclic reduction.
void reduce_lines(const Kernels& kernels, std::vector<Step>& steps) {
    for (Step& step : steps) {
        if (step.kind != StepKind::line) continue;
        const auto& push = step.push<glsl::LinePush>();
        const bool can_reduce_it = kernels.has(Kernel::line_cyclic) && can_reduce(push, kernels.group);
        if (kernels.has(Kernel::line_parts) && can_part(push, kernels.group) &&
            (!can_reduce_it || push.particle_count > glsl::parts_least_particles)) {
            step.kernel = Kernel::line_parts;
            step.subgroup = kernels.group.subgroup;
        } else if (can_reduce_it) {
            step.kernel = Kernel::line_cyclic;
        }
    }
}

}  // namespace

std::vector<Step> explicit_steps_together(const std::vector<Step>& steps, Kernel kernel,
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
        merged.back().kernel = kernel;
        for (const std::size_t place : together) taken[place] = true;
    }
    return merged;
}

std::vector<Step> springs_together(const SimulationModel& model, Kernel kernel, const std::vector<Step>& steps) {
    const SpringJoiner joiner(model, kernel, steps);
    JoinedSteps joined;
    for (std::size_t k = 0; k < steps.size();) {
        const std::size_t length = joiner.length_at(k);
        if (length > 0)
            joined.add_joined(joiner.made_of(k, length));
        else
            joined.add(steps[k]);
        k += std::max<std::size_t>(length, 1);
    }
    return joined.steps();
}

std::vector<Step> twists_together(Kernel kernel, const std::vector<Step>& steps) {
    JoinedSteps joined;
    for (const Step& step : steps) {
        const auto is_same = [&step](const Step& other) {
            return other.kind == StepKind::all_twist && other.cloth == step.cloth && other.substep == step.substep;
        };
        if (step.kind != StepKind::twist) {
            joined.add(step);
        } else if (!is_same(joined.steps().back())) {
            const auto& push = step.push<glsl::TwistPush>();
            Step all = step;
            all.kind = StepKind::all_twist;
            all.kernel = kernel;
            all.constants = glsl::AllTwistPush{push.grid, push.compliance, push.compliance_bdf2};
            joined.add_joined(all);
        }
    }
    return joined.steps();
}

bool has_direction(const glsl::AllSpringsPush& push, int direction) {
    const float lengths[] = {push.rest_length.x, push.rest_length.y, push.rest_length.z, push.rest_length.w};
    return lengths[direction] > 0;
}

Tile tile_of(StepKind kind, const Grid& grid) {
    Tile tile{glsl::sweep_tile_width, glsl::twist_tile_halo};
    if (kind == StepKind::explicit_step) tile = {glsl::explicit_tile_width, glsl::explicit_tile_halo};
    if (kind == StepKind::all_springs) tile.halo = glsl::spring_tile_halo;
    const bool is_whole = grid.columns() <= tile.width && grid.rows() <= tile.width;
    return {tile.width, is_whole ? 0 : tile.halo};
}

std::uint32_t tile_invocations(std::uint32_t particles, const Tile& tile) {
    const std::uint32_t own = tile.width - 2 * tile.halo;
    return (particles + own - 1) / own * tile.width;
}

std::vector<Step> kernel_steps(const SimulationModel& model, const Kernels& kernels) {
    std::vector<Step> steps = frame_steps(model);
    if (kernels.has(Kernel::explicit_stream)) {
        const auto size = [](std::size_t) { return FlightSize{glsl::stream_steps, glsl::stream_steps}; };
        steps = explicit_steps_together(steps, Kernel::explicit_stream, size);
        stream_single_steps(model, steps);
    } else if (kernels.has(Kernel::explicit_tile)) {
        const auto size = [&](std::size_t cloth) { return tile_flight(model.cloths[cloth].grid); };
        steps = explicit_steps_together(steps, Kernel::explicit_tile, size);
    }
    for (const Kernel kernel : {Kernel::spring_stream, Kernel::spring_tile})
        if (kernels.has(kernel)) steps = springs_together(model, kernel, steps);
    for (const Kernel kernel : {Kernel::twist_stream, Kernel::twist_tile})
        if (kernels.has(kernel)) steps = twists_together(kernel, steps);
    reduce_lines(kernels, steps);
    return steps;
}

}  // namespace drape
