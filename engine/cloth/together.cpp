#include "cloth/together.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>

#include "world/cloth_keys.h"
#include "world/contact_shape.h"

namespace drape {

namespace {

/// A cloth with more particles keeps its own dispatches, whose overhead is small beside their work (docs/devices.md).
constexpr std::uint64_t most_particles = 128 * 128;

/// Returns whether two cloths can share dispatches as far as one key is concerned.
bool have_same_shape(ClothKey key, const Cloth& one, const Cloth& other) {
    switch (key) {
        case ClothKey::grid:
            return one.grid == other.grid;
        case ClothKey::holes:
            return one.holes == other.holes;
        case ClothKey::rest:
            return one.rest == other.rest;
        case ClothKey::panel:
            return one.panel == other.panel;
        case ClothKey::cell_stiffness:
            return one.cell_stiffness == other.cell_stiffness;
        case ClothKey::cell_density:
            return one.cell_density == other.cell_density;
        case ClothKey::stiffness_keys:  // the factor of a frame is passed for one cloth at a time
            return one.stiffness_keys.empty() && other.stiffness_keys.empty();
        case ClothKey::self_collision:
            return one.self_collision.has_value() == other.self_collision.has_value();
        case ClothKey::loads:
            return std::ranges::equal(one.loads, other.loads, {}, &Load::particles, &Load::particles);
        case ClothKey::particle_friction:
        case ClothKey::particle_thickness:
            return has_skin(one) == has_skin(other);
        // Each cloth has its own numbers and images for these; cloths_together compares whatever decides the steps.
        case ClothKey::name:
        case ClothKey::size:
        case ClothKey::placement:
        case ClothKey::start:
        case ClothKey::areal_density:
        case ClothKey::stiffness:
        case ClothKey::damping:
        case ClothKey::friction:
        case ClothKey::thickness:
        case ClothKey::contact:
        case ClothKey::velocity:
        case ClothKey::velocities:
        case ClothKey::pins:
        case ClothKey::appearance:
        // In a scene where a cloth tears, no cloths share dispatches.
        case ClothKey::tear:
        case ClothKey::cell_tear:
            return true;
    }
    return false;
}

/// Returns whether a key only concerns looks, or what the state of a cloth contains at the start.
bool is_in_state(ClothKey key) {
    switch (key) {
        case ClothKey::name:
        case ClothKey::placement:
        case ClothKey::start:
        case ClothKey::velocity:
        case ClothKey::velocities:
        case ClothKey::pins:
        case ClothKey::appearance:
            return true;
        case ClothKey::grid:
        case ClothKey::size:
        case ClothKey::rest:
        case ClothKey::panel:
        case ClothKey::areal_density:
        case ClothKey::stiffness:
        case ClothKey::stiffness_keys:
        case ClothKey::damping:
        case ClothKey::friction:
        case ClothKey::thickness:
        case ClothKey::contact:
        case ClothKey::self_collision:
        case ClothKey::holes:
        case ClothKey::cell_stiffness:
        case ClothKey::cell_density:
        case ClothKey::tear:
        case ClothKey::cell_tear:
        case ClothKey::particle_friction:
        case ClothKey::particle_thickness:
        case ClothKey::loads:
            return false;
    }
    return false;
}

float sign(float number) { return number > 0 ? 1.0f : 0.0f; }
glsl::vec4 sign(glsl::vec4 numbers) { return {sign(numbers.x), sign(numbers.y), sign(numbers.z), sign(numbers.w)}; }

/// Reduces a step's constants to those that decide which step it is and which pipeline runs it. Of the cloth's numbers
/// only whether they are zero remains, where a specialization constant of the shader depends on it.
struct StructureOf {
    StepConstants operator()(const glsl::ForcePush& push) const { return glsl::ForcePush{push.grid}; }
    StepConstants operator()(const glsl::PredictPush& push) const { return glsl::PredictPush{push.grid}; }
    StepConstants operator()(const glsl::ExplicitPush& push) const {
        glsl::ExplicitPush structure{push.grid};
        structure.relative_stiffness.z = sign(push.relative_stiffness.z);
        structure.twist = sign(push.twist);
        return structure;
    }
    StepConstants operator()(const glsl::BendTargetPush& push) const {
        return glsl::BendTargetPush{push.grid, push.gathers, 0, sign(push.stiffness), sign(push.stiffness_bdf2)};
    }
    StepConstants operator()(glsl::BendPush push) const {
        push.compliance = 0;
        return push;
    }
    StepConstants operator()(glsl::TwistPush push) const {
        push.compliance = push.compliance_bdf2 = 0;
        return push;
    }
    StepConstants operator()(const glsl::AllTwistPush& push) const { return glsl::AllTwistPush{push.grid}; }
    StepConstants operator()(glsl::SpringPush push) const {
        push.rest_length = push.compression = 0;
        push.compliance = sign(push.compliance);
        return push;
    }
    StepConstants operator()(const glsl::AllSpringsPush& push) const {
        return glsl::AllSpringsPush{push.grid, 0, 0, sign(push.rest_length), sign(push.compliance)};
    }
    StepConstants operator()(const glsl::LinePush& push) const {
        glsl::LinePush structure{push.grid, push.step, push.line_count, push.particle_count, push.seam, push.channel};
        structure.bend = sign(push.bend);
        return structure;
    }
    /// Members' cloths enter contact together, each with its place on the sheet; the cloths of one scene enter one by
    /// one, since the last one inspects the others.
    StepConstants operator()(glsl::SelfClothPush push) const {
        if (push.member_count == 1) return push;
        push.first = {};
        push.thickness = 0;
        push.member = push.body = 0;
        return push;
    }
    StepConstants operator()(const glsl::NestedPush& push) const {
        return glsl::NestedPush{push.grid, push.block_count, push.first_pin, sign(push.rest_length)};
    }
    StepConstants operator()(const glsl::RotationPush& push) const {
        glsl::RotationPush structure{push.grid};
        structure.sum_count = push.sum_count;
        return structure;
    }
    StepConstants operator()(const glsl::ContactTurnPush& push) const {
        glsl::ContactTurnPush structure{push.grid};
        structure.sum_count = push.sum_count;
        structure.paid = push.paid;
        return structure;
    }
    StepConstants operator()(const glsl::MomentumPush& push) const {
        return glsl::MomentumPush{push.grid, push.sign, 0, sign(push.rest_length), {}};
    }
    template <class Other>
    StepConstants operator()(const Other& other) const {
        return other;
    }
};

/// Returns whether a step uses no data but its constants, the images of the state and lists that can be joined.
bool in_images(const Step& step) {
    switch (step.kind) {
        case StepKind::release:
        case StepKind::wind:
        case StepKind::pin:
        case StepKind::predict:
        case StepKind::force:
        case StepKind::explicit_step:
        case StepKind::bend_targets:
        case StepKind::bend_pulls:
        case StepKind::bend:
        case StepKind::twist:
        case StepKind::all_twist:
        case StepKind::spring:
        case StepKind::all_springs:
        case StepKind::line:
        case StepKind::nested:
        case StepKind::torque:
        case StepKind::rotate:
        case StepKind::tether:
        case StepKind::collider_edges:
        case StepKind::collide:
        case StepKind::clear_impulses:
        case StepKind::momentum:
        case StepKind::worst_impulses:
        case StepKind::self_gather:
        case StepKind::self_impulses:
        case StepKind::self_return:
        case StepKind::self_couples:
        case StepKind::self_turn:
            return true;
        default:
            return false;
    }
}

bool ends_section(const Step& step) { return step.cloth == between_cloths || step.is_of_bodies(); }

bool same_constants(const StepConstants& one, const StepConstants& other) {
    return std::visit(
        [&]<class Push>(const Push& constants) {
            const auto* const others = std::get_if<Push>(&other);
            return others && (std::is_empty_v<Push> || std::memcmp(&constants, others, sizeof constants) == 0);
        },
        one);
}

bool same_structure(const StepConstants& one, const StepConstants& other) {
    return same_constants(std::visit(StructureOf(), one), std::visit(StructureOf(), other));
}

bool same_steps(const std::vector<MethodStep>& one, const std::vector<MethodStep>& other) {
    return std::ranges::equal(one, other, [](const MethodStep& a, const MethodStep& b) {
        return a.kind == b.kind && same_structure(a.constants, b.constants);
    });
}

/// Returns whether boxes and rounds are the same; the pins may be elsewhere.
bool same_rounds(const std::vector<glsl::ivec4>& one, const std::vector<glsl::ivec4>& other) {
    return std::ranges::equal(one, other, {}, &glsl::ivec4::z, &glsl::ivec4::z);
}

/// Returns whether the cloths need the same fields and take the same steps of the method.
bool same_scheme(const MethodScheme& one, const MethodScheme& other) {
    const auto fields = [](const MethodScheme& scheme) {
        return std::tuple(scheme.spare_state, scheme.spare_displacement, scheme.spare_tension, scheme.second_order,
                          scheme.line_scratch, scheme.carries_tension, scheme.release_stiffness.x > 0);
    };
    return fields(one) == fields(other) && same_steps(one.prediction, other.prediction) &&
           same_steps(one.once, other.once) && same_steps(one.iterated, other.iterated) &&
           same_steps(one.ended, other.ended) && same_rounds(one.nested_table, other.nested_table);
}

/// Returns whether the schedule puts the same steps around those of the method.
bool same_schedule(const ClothModel& one, const ClothModel& other) {
    const auto steps = [](const ClothModel& cloth) {
        return std::tuple(cloth.has_motion, cloth.has_release, cloth.tethers.empty(), cloth.edge_reach > 0);
    };
    return steps(one) == steps(other);
}

bool same_place(const Step& one, const Step& other) {
    return one.kind == other.kind && one.substep == other.substep && one.iteration == other.iteration &&
           one.last == other.last && one.count == other.count && one.conditional == other.conditional &&
           one.after_edges == other.after_edges && one.after_impulses == other.after_impulses &&
           one.turns == other.turns && one.kernel == other.kernel;
}

bool same_step(const Step& one, const Step& other) {
    return in_images(one) && !one.conditional && same_place(one, other) &&
           same_structure(one.constants, other.constants);
}

/// The steps that the cloths of a list have yet to take in a substep, in each cloth's order.
class Substep {
  public:
    explicit Substep(std::size_t cloths) : steps_(cloths), next_(cloths) {}
    void add(std::size_t place, const Step& step) { steps_[place].push_back(&step); }

    /// Takes a step for all cloths at once when all have come to the same one; until then each goes on alone.
    void merge(std::vector<Step>& merged) {
        while (!is_done()) {
            if (all_are_at_one()) {
                merged.push_back(joined());
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
    /// Returns the step that is next for all cloths.
    Step joined() const {
        Step step = *front(0);
        step.together = true;
        for (std::size_t place = 0; place < steps_.size(); ++place) step.own.push_back(front(place)->constants);
        const auto is_first = [&](const StepConstants& own) { return same_constants(own, step.constants); };
        if (std::ranges::all_of(step.own, is_first)) step.own.clear();
        return step;
    }
    /// Takes a cloth's next step for it alone, if some other cloth has no such step left, or, with `all`, in any case.
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

/// Puts a cloth into the list of those with which it can share dispatches, or begins a new list.
template <class Alike>
void put(std::size_t cloth, std::vector<std::vector<std::size_t>>& lists, const Alike& alike) {
    const auto list =
        std::ranges::find_if(lists, [&](const std::vector<std::size_t>& each) { return alike(each.front(), cloth); });
    if (list == lists.end())
        lists.push_back({cloth});
    else
        list->push_back(cloth);
}

/// Contact of a member's cloths begins with the last of them, so they are not put on the sheet together.
bool members_meet(const SimulationModel& model) { return model.member_count > 1 && model.self_contact; }

}  // namespace

bool have_same_numbers(const Cloth& one, const Cloth& other) {
    const auto differs = differences(one, other);
    return std::ranges::all_of(
        cloth_keys, [&](ClothKey key) { return is_in_state(key) || !differs[static_cast<std::size_t>(key)]; });
}

std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene) {
    std::vector<std::vector<std::size_t>> lists;
    const SolverSettings& solver = scene.solver;
    const bool own_iterations = solver.tolerance > 0 && solver.iterations > 1 && named(solver.method).iterates();
    if (scene.comes_apart() || own_iterations || !scene.seams.empty()) return lists;
    for (std::size_t k = 0; k < scene.cloths.size(); ++k) {
        const Cloth& cloth = scene.cloths[k];
        if (std::uint64_t{cloth.grid[0]} * cloth.grid[1] > most_particles) continue;
        put(k, lists, [&](std::size_t first, std::size_t) {
            return std::ranges::all_of(cloth_keys,
                                       [&](ClothKey key) { return have_same_shape(key, scene.cloths[first], cloth); });
        });
    }
    std::erase_if(lists, [](const std::vector<std::size_t>& list) { return list.size() == 1; });
    return lists;
}

std::vector<std::vector<std::size_t>> cloths_together(const SimulationModel& model) {
    std::vector<std::vector<std::size_t>> lists;
    const std::size_t each = model.cloths.size() / model.member_count;
    for (const std::vector<std::size_t>& alike : cloths_alike(model.scene)) {
        std::vector<std::vector<std::size_t>> parts;
        for (const std::size_t cloth : alike)
            put(cloth, parts, [&](std::size_t first, std::size_t other) {
                const ClothModel &one = model.cloths[first], &another = model.cloths[other];
                return same_schedule(one, another) && same_scheme(one.scheme, another.scheme) &&
                       (!members_meet(model) || first % each == other % each);
            });
        for (std::vector<std::size_t>& part : parts)
            if (part.size() > 1) lists.push_back(std::move(part));
    }
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
    std::map<std::tuple<std::size_t, std::uint32_t, std::size_t>, Substep>
        substeps;          // by list, substep, and section of the substep
    std::size_t part = 0;  // counts steps of contact and of bodies, past which no step may move
    for (const Step& step : steps) {
        part += ends_section(step) ? 1 : 0;
        if (const auto place = places.find(step.cloth); place != places.end())
            substeps.try_emplace({place->second.list, step.substep, part}, lists[place->second.list].size())
                .first->second.add(place->second.within, step);
    }
    std::vector<Step> merged;
    part = 0;
    for (const Step& step : steps) {
        part += ends_section(step) ? 1 : 0;
        const auto place = places.find(step.cloth);
        if (place == places.end()) {
            merged.push_back(step);
            continue;
        }
        // The first step of a section of a substep adds all steps of the section.
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
