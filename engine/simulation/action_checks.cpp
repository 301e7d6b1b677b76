// Which actions members cannot follow.
#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/vectors.h"
#include "simulation/member_actions.h"
#include "world/motion.h"

namespace drape {

namespace {

constexpr std::size_t numbers_of_key = 6, numbers_of_grasp = 4;

void check_list(std::size_t size, const char* name, bool is_control, std::size_t per_member, std::size_t members) {
    if (size == 0) return;
    if (!is_control)
        throw ActionError(fmt::format("actions: made without control of {0}: ask for it in controls", name), 0);
    if (size != per_member * members)
        throw ActionError(fmt::format("actions: {} has {} numbers, {} members with {} each are {}", name, size, members,
                                      per_member, per_member * members),
                          0);
}

void check_numbers(std::span<const double> numbers, const char* name, bool is_control, std::size_t per_member,
                   std::size_t members) {
    check_list(numbers.size(), name, is_control, per_member, members);
    for (std::size_t k = 0; k < numbers.size(); ++k)
        if (!(std::abs(numbers[k]) <= FLT_MAX))
            throw ActionError(fmt::format("actions: member {}: {}: number {} is {}, expected a finite one",
                                          k / per_member, name, k % per_member, numbers[k]),
                              k / per_member);
}

/// A pressure has no direction.
void check_pressures(std::span<const double> told, const SimulationModel& model, std::size_t member) {
    std::size_t first = member * 3 * load_count(model);
    for (const Cloth& cloth : model.scene.cloths)
        for (const Load& load : cloth.loads) {
            if (!told.empty() && load.presses() && (told[first + 1] != 0 || told[first + 2] != 0))
                throw ActionError(fmt::format("actions: member {}: loads: number {} is {}, expected 0 after a pressure",
                                              member, first % (3 * load_count(model)) + (told[first + 1] != 0 ? 1 : 2),
                                              told[first + 1] != 0 ? told[first + 1] : told[first + 2]),
                                  member);
            first += 3;
        }
}

void check_bodies(const EnsembleActions& actions, const EnsembleControls& controls, const SimulationModel& model,
                  std::size_t members) {
    const std::size_t bodies = body_count(model), each = numbers_of_key * bodies;
    const std::size_t told = actions.body_forces.size() + actions.body_impulses.size() +
                             actions.body_velocities.size() + actions.body_sets.size();
    check_list(told > 0 && !controls.bodies ? 1 : 0, "bodies", controls.bodies, 0, members);
    check_numbers(actions.body_forces, "body_forces", true, each, members);
    check_numbers(actions.body_impulses, "body_impulses", true, each, members);
    check_numbers(actions.body_velocities, "body_velocities", true, each, members);
    check_list(actions.body_sets.size(), "body_sets", true, bodies, members);
    if (!actions.body_sets.empty() && actions.body_velocities.empty())
        throw ActionError("actions: body_sets: expected body_velocities too, got none", 0);
}

/// A pin or hand of one cloth, in the step before and in this one.
struct Holder {
    std::string name;
    bool is_hand, before, now;
    IndexBox held, takes;  ///< before and now
    bool blocks() const { return before || now; }
};

bool meet(const IndexBox& a, const IndexBox& b) {
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (a.first[axis] > b.last[axis] || b.first[axis] > a.last[axis]) return false;
    return true;
}

/// Checks a member's pins and hands.
class Hands {
  public:
    Hands(const EnsembleActions& actions, const SimulationModel& model, std::uint32_t frame, std::size_t number)
        : actions_(actions), model_(model), number_(number), from_(frame / model.scene.time.fps) {}

    void check() const {
        std::size_t first_pin = number_ * pin_count(model_);
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
            std::vector<Holder> all;
            const std::vector<Pin>& pins = model_.scene.cloths[cloth].pins;
            for (std::size_t k = 0; k < pins.size(); ++k) all.push_back(pin(cloth, k, first_pin + k));
            for (const DynamicPin& each : model_.cloths[cloth].dynamic_pins)
                if (each.hand) all.push_back(hand(cloth, each));
            check_takers(all);
            first_pin += pins.size();
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw ActionError(fmt::format("actions: member {}: {}", number_, why), number_);
    }

    Holder pin(std::size_t cloth, std::size_t number, std::size_t index) const {
        const IndexBox& box = model_.scene.cloths[cloth].pins[number].particles;
        Holder holder{
            fmt::format("pin {}", index % std::max<std::size_t>(pin_count(model_), 1)), false, true, true, box, box};
        for (const DynamicPin& each : model_.cloths[cloth].dynamic_pins) {
            if (each.hand || each.number != number) continue;
            // A scene's release is over once a frame has gone by.
            holder.before = each.holds(from_ - 1 / model_.scene.time.fps + 1e-9);
            holder.now = actions_.holds.empty() ? holder.before : actions_.holds[index] != 0;
            if (holder.blocks()) check_way(cloth, each, holder.name, actions_.pins, index);
        }
        return holder;
    }

    Holder hand(std::size_t cloth, const DynamicPin& pin) const {
        const std::size_t index = number_ * model_.options.hands.size() + *pin.hand;
        Holder holder{fmt::format("hand {}", *pin.hand), true, pin.holds(from_), pin.holds(from_), pin.held, pin.held};
        if (!actions_.grasps.empty()) {
            check_grasp(cloth, holder.name, actions_.grasps.subspan(numbers_of_grasp * index, numbers_of_grasp));
            const std::optional<IndexBox> grasp = grasp_of(actions_, index);
            holder.now = grasp.has_value();
            if (grasp) holder.takes = *grasp;
        }
        if (holder.before && holder.now && holder.held != holder.takes)
            refuse(fmt::format("grasps: {} holds other particles: let go of them a step before", holder.name));
        if (holder.now && pin.path.keys.empty() && actions_.hands.empty())
            refuse(fmt::format("grasps: {} is nowhere yet: say where in hands", holder.name));
        if (holder.blocks() && !pin.path.keys.empty()) check_way(cloth, pin, holder.name, actions_.hands, index);
        return holder;
    }

    void check_grasp(std::size_t cloth, const std::string& name, std::span<const std::int32_t> grasp) const {
        if (std::ranges::all_of(grasp, [](std::int32_t each) { return each == -1; })) return;
        const ClothModel& model = model_.cloths[cloth];
        const auto columns = static_cast<std::int32_t>(model.grid.columns()),
                   rows = static_cast<std::int32_t>(model.grid.rows());
        const bool inside = grasp[0] >= 0 && grasp[1] >= 0 && grasp[0] <= grasp[2] && grasp[1] <= grasp[3] &&
                            grasp[2] < columns && grasp[3] < rows;
        bool any = false;
        for (std::int32_t row = grasp[1]; inside && row <= grasp[3]; ++row)
            for (std::int32_t column = grasp[0]; column <= grasp[2]; ++column)
                any = any || model.free_weight[model.grid.particle(static_cast<std::uint32_t>(column),
                                                                   static_cast<std::uint32_t>(row))] > 0;
        if (!any)
            refuse(
                fmt::format("grasps: {}: columns {} to {} of rows {} to {} are no particles of cloth '{}', which has "
                            "{} columns and {} rows",
                            name, grasp[0], grasp[2], grasp[1], grasp[3], model.name, columns, rows));
    }

    /// What holds cloth must not jump.
    void check_way(std::size_t cloth, const DynamicPin& pin, const std::string& name, std::span<const double> targets,
                   std::size_t index) const {
        if (targets.empty()) return;
        const double* const target = &targets[numbers_of_key * index];
        const double way = length(minus(Vec3{target[0], target[1], target[2]}, key_at(pin.path, from_).translate));
        const double most = double{model_.cloths[cloth].reach()};
        if (!(way <= most))
            refuse(
                fmt::format("{0}: {1} holds cloth and jumps {2:.3g} m in a step, at most {3:.3g} m, the cloth's "
                            "diagonal, can be followed",
                            pin.hand ? "hands" : "pins", name, way, most));
    }

    void check_takers(const std::vector<Holder>& all) const {
        for (const Holder& taker : all) {
            if (taker.before || !taker.now) continue;
            for (const Holder& other : all)
                if (&other != &taker && (taker.is_hand || other.is_hand) && other.blocks() &&
                    (meet(taker.takes, other.now ? other.takes : other.held)))
                    refuse(fmt::format("{}: {} takes what {} holds: have that let go a step before",
                                       taker.is_hand ? "grasps" : "holds", taker.name, other.name));
        }
    }

    const EnsembleActions& actions_;
    const SimulationModel& model_;
    std::size_t number_;
    double from_;
};

}  // namespace

std::size_t pin_count(const SimulationModel& model) {
    std::size_t count = 0;
    for (const Cloth& cloth : model.scene.cloths) count += cloth.pins.size();
    return count;
}

std::size_t load_count(const SimulationModel& model) {
    std::size_t count = 0;
    for (const Cloth& cloth : model.scene.cloths) count += cloth.loads.size();
    return count;
}

std::optional<IndexBox> grasp_of(const EnsembleActions& actions, std::size_t index) {
    const std::int32_t* const grasp = &actions.grasps[numbers_of_grasp * index];
    if (grasp[0] < 0) return std::nullopt;
    const auto number = [&](std::size_t k) { return static_cast<std::uint32_t>(grasp[k]); };
    return IndexBox{{number(0), number(1)}, {number(2), number(3)}};
}

void check_lists(const EnsembleActions& actions, const EnsembleControls& controls, const SimulationModel& model,
                 std::size_t count) {
    const std::size_t pins = pin_count(model), hands = controls.hands.size();
    check_numbers(actions.wind, "wind", controls.wind, 3, count);
    check_numbers(actions.gravity, "gravity", controls.gravity, 3, count);
    check_numbers(actions.pins, "pins", controls.pins, numbers_of_key * pins, count);
    check_numbers(actions.colliders, "colliders", controls.colliders, numbers_of_key * model.scene.colliders.size(),
                  count);
    check_numbers(actions.hands, "hands", hands > 0, numbers_of_key * hands, count);
    check_numbers(actions.loads, "loads", controls.loads, 3 * load_count(model), count);
    check_bodies(actions, controls, model, count);
    check_list(actions.holds.size(), "holds", controls.holds, pins, count);
    check_list(actions.grasps.size(), "grasps", hands > 0, numbers_of_grasp * hands, count);
}

namespace {

void check_member(const EnsembleActions& actions, std::size_t number, std::uint32_t frame,
                  const SimulationModel& model) {
    Hands(actions, model, frame, number).check();
    check_pressures(actions.loads, model, number);
}

}  // namespace

void check_actions(const EnsembleActions& actions, const EnsembleControls& controls, const Members& members) {
    check_lists(actions, controls, members.front()->model, members.size());
    for (std::size_t number = 0; number < members.size(); ++number)
        check_member(actions, number, members[number]->frame, members[number]->model);
}

void check_actions(const EnsembleActions& actions, const EnsembleControls& controls, const SimulationModel& model,
                   std::uint32_t frame) {
    check_lists(actions, controls, model, 1);
    check_member(actions, 0, frame, model);
}

}  // namespace drape
