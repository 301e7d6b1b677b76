#include "cloth/together.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>

namespace drape {

namespace {

/// A cloth of more particles keeps its own dispatches, which cost little beside what they do (docs/devices.md).
constexpr std::uint64_t most_particles = 128 * 128;

bool alike(const Cloth& one, const Cloth& other) {
    Cloth same = other;
    same.name = one.name;
    same.placement = one.placement;
    same.velocity = one.velocity;
    same.pins = one.pins;
    same.appearance = one.appearance;
    return same == one;
}

/// Returns whether a step uses no other data than its constants, the images of the state and lists that can be joined.
bool in_images(const Step& step) {
    switch (step.kind) {
        case StepKind::release:
        case StepKind::wind:
        case StepKind::pin:
        case StepKind::predict:
        case StepKind::force:
        case StepKind::explicit_step:
        case StepKind::bend:
        case StepKind::twist:
        case StepKind::all_twist:
        case StepKind::spring:
        case StepKind::all_springs:
        case StepKind::line:
        case StepKind::nested:
        case StepKind::tether:
        case StepKind::box_edges:
        case StepKind::collide:
            return true;
        default:
            return false;
    }
}

bool same_constants(const StepConstants& one, const StepConstants& other) {
    return std::visit(
        [&](const auto& constants) {
            const auto* const others = std::get_if<std::decay_t<decltype(constants)>>(&other);
            return others && std::memcmp(&constants, others, sizeof constants) == 0;
        },
        one);
}

bool same_place(const Step& one, const Step& other) {
    return one.kind == other.kind && one.substep == other.substep && one.iteration == other.iteration &&
           one.last == other.last && one.count == other.count && one.conditional == other.conditional &&
           one.after_edges == other.after_edges && one.turns == other.turns && one.kernel == other.kernel;
}

bool same_step(const Step& one, const Step& other) {
    return in_images(one) && !one.conditional && same_place(one, other) &&
           same_constants(one.constants, other.constants);
}

/// The steps that the cloths of a list still have to take in a substep, each cloth's in its order.
class Substep {
  public:
    explicit Substep(std::size_t cloths) : steps_(cloths), next_(cloths) {}
    void add(std::size_t place, const Step& step) { steps_[place].push_back(&step); }

    /// Takes a step together where all cloths have come to the same one; until then each goes on alone.
    void merge(std::vector<Step>& merged) {
        while (!is_done()) {
            if (all_are_at_one()) {
                merged.push_back(*front(0));
                merged.back().together = true;
                for (std::size_t& next : next_) ++next;
            } else if (!go_on_alone(false, merged)) {
                go_on_alone(true, merged);
            }
        }
    }

  private:
    const Step* front(std::size_t place) const {
        return next_[place] < steps_[place].size() ? steps_[place][next_[place]] : nullptr;
    }
    bool is_done() const {
        for (std::size_t place = 0; place < steps_.size(); ++place)
            if (front(place)) return false;
        return true;
    }
    bool all_are_at_one() const {
        for (std::size_t place = 0; place < steps_.size(); ++place)
            if (!front(place) || !same_step(*front(0), *front(place))) return false;
        return true;
    }
    /// Takes each cloth's next step where some other cloth will not come to such a step, or, with `all`, in any case.
    /// Returns whether it took any.
    bool go_on_alone(bool all, std::vector<Step>& merged) {
        bool any = false;
        for (std::size_t place = 0; place < steps_.size(); ++place) {
            if (!front(place) || (!all && everyone_comes_to(*front(place)))) continue;
            merged.push_back(*front(place));
            ++next_[place];
            any = true;
        }
        return any;
    }
    bool everyone_comes_to(const Step& step) const {
        for (std::size_t place = 0; place < steps_.size(); ++place) {
            const auto begin = steps_[place].begin() + static_cast<std::ptrdiff_t>(next_[place]);
            if (std::none_of(begin, steps_[place].end(), [&](const Step* other) { return same_step(step, *other); }))
                return false;
        }
        return true;
    }

    std::vector<std::vector<const Step*>> steps_;
    std::vector<std::size_t> next_;
};

}  // namespace

std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene) {
    std::vector<std::vector<std::size_t>> lists;
    const SolverSettings& solver = scene.solver;
    const bool own_iterations = solver.tolerance > 0 && solver.iterations > 1 && named(solver.method).iterates();
    if (!scene.cutters.empty() || own_iterations) return lists;
    for (std::size_t k = 0; k < scene.cloths.size(); ++k) {
        const Cloth& cloth = scene.cloths[k];
        if (std::uint64_t{cloth.grid[0]} * cloth.grid[1] > most_particles) continue;
        const auto list = std::ranges::find_if(
            lists, [&](const std::vector<std::size_t>& each) { return alike(scene.cloths[each.front()], cloth); });
        if (list == lists.end())
            lists.push_back({k});
        else
            list->push_back(k);
    }
    std::erase_if(lists, [](const std::vector<std::size_t>& list) { return list.size() == 1; });
    return lists;
}

std::vector<Step> steps_together(const std::vector<Step>& steps, const std::vector<std::vector<std::size_t>>& lists) {
    struct Place {
        std::size_t list, within;
    };
    std::map<std::size_t, Place> places;  // by cloth
    for (std::size_t list = 0; list < lists.size(); ++list)
        for (std::size_t within = 0; within < lists[list].size(); ++within)
            places[lists[list][within]] = {list, within};
    std::map<std::tuple<std::size_t, std::uint32_t, std::size_t>, Substep> substeps;  // by list, substep, part of it
    std::size_t part = 0;  // counts steps of contact, across which no step may move
    for (const Step& step : steps) {
        part += step.cloth == between_cloths ? 1 : 0;
        if (const auto place = places.find(step.cloth); place != places.end())
            substeps.try_emplace({place->second.list, step.substep, part}, lists[place->second.list].size())
                .first->second.add(place->second.within, step);
    }
    std::vector<Step> merged;
    part = 0;
    for (const Step& step : steps) {
        part += step.cloth == between_cloths ? 1 : 0;
        const auto place = places.find(step.cloth);
        if (place == places.end()) {
            merged.push_back(step);
            continue;
        }
        // The first step of a substep's part brings all of its steps.
        const auto substep = substeps.find({place->second.list, step.substep, part});
        if (substep == substeps.end()) continue;
        substep->second.merge(merged);
        substeps.erase(substep);
    }
    for (Step& step : merged)
        if (step.together) step.cloth = lists[places.at(step.cloth).list].front();
    return merged;
}

}  // namespace drape
