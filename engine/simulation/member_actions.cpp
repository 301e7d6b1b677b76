#include "simulation/member_actions.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/vectors.h"
#include "world/motion.h"
#include "world/weather.h"

namespace drape {

namespace {

constexpr std::size_t numbers_of_key = 6;  // translate, rotate

MotionKey key_of(double time, std::span<const double> numbers) {
    return {time, {numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

/// Changes a path so that from `from` to `to` (s) it moves to a key at constant speed, from wherever it is at `from`.
void go(MotionPath& path, double from, double to, std::span<const double> target) {
    const MotionKey now = key_at(path, from), end = key_of(to, target);
    // Keys beyond both ends make the cubic between the two times a straight line (world/motion.h).
    const auto beyond = [&](double at, double share) {
        MotionKey key{at, {}, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            key.translate[k] = now.translate[k] + share * (end.translate[k] - now.translate[k]);
            key.rotate[k] = now.rotate[k] + share * (end.rotate[k] - now.rotate[k]);
        }
        return key;
    };
    path.keys = {beyond(from - (to - from), -1), now, end, beyond(to + (to - from), 2)};
}

/// A member's step, and its part of the actions.
class Acting {
  public:
    Acting(const EnsembleActions& actions, std::size_t number, std::uint32_t frame, SimulationModel& model,
           Acted& acted)
        : actions_(actions),
          number_(number),
          model_(model),
          acted_(acted),
          from_(frame / model.scene.time.fps),
          to_((frame + 1) / model.scene.time.fps) {}

    void blow() {
        if (actions_.wind.empty()) return;
        Wind& wind = model_.scene.wind;
        wind.velocity = vector_of(actions_.wind);
        wind.gust.amplitude = 0;
        wind.keys.clear();
    }

    void weigh() {
        if (actions_.gravity.empty()) return;
        SceneDescription& scene = model_.scene;
        scene.gravity_keys =
            keys_to<VectorKey>(vector_of(actions_.gravity), gravity_at(scene, 0), strongest_gravity(scene));
    }

    void load() {
        std::size_t index = number_ * load_count(model_);
        for (Cloth& cloth : model_.scene.cloths)
            for (Load& each : cloth.loads) {
                if (actions_.loads.empty()) return;
                const Vec3 now{actions_.loads[3 * index], actions_.loads[3 * index + 1], actions_.loads[3 * index + 2]};
                const double most = strongest(each);
                if (each.presses())
                    each.pressure_keys = keys_to<NumberKey>(now[0], pressure_at(each, 0), most);
                else
                    each.force_keys = keys_to<VectorKey>(now, force_at(each, 0), Vec3{most, 0, 0});
                ++index;
            }
    }

    void move_pins() {
        std::size_t pin = 0;
        for (std::size_t k = 0; k < model_.cloths.size(); ++k) {
            for (DynamicPin& each : model_.cloths[k].dynamic_pins) {
                if (each.hand) {
                    move_hand(each);
                    continue;
                }
                move_pin(each, number_ * pin_count(model_) + pin + each.number);
                model_.scene.cloths[k].pins[each.number].path = each.path;
            }
            pin += model_.scene.cloths[k].pins.size();
        }
        acted_.pins = acted_.pins || !actions_.pins.empty();
    }

    void move_colliders() {
        for (std::size_t k = 0; k < model_.scene.colliders.size(); ++k) {
            if (model_.scene.colliders[k].mass) continue;  // gravity and cloth move it
            MotionPath& path = model_.scene.colliders[k].path;
            move(path, actions_.colliders, number_ * model_.scene.colliders.size() + k, acted_.colliders);
            for (std::vector<KeptCollider>& list : model_.kept_colliders) list[k].collider.path = path;
        }
        acted_.colliders = acted_.colliders || !actions_.colliders.empty();
    }

    void push_bodies() {
        std::vector<Body>& bodies = model_.bodies.front().bodies;
        for (std::size_t k = 0; k < bodies.size() && model_.options.bodies; ++k) {
            BodyActions& acts = bodies[k].acts;
            const std::size_t index = number_ * bodies.size() + k;
            const BodyActions before = acts;
            take(actions_.body_forces, index, acts.force, acts.moment);
            acts.impulse = acts.twist = acts.velocity = acts.turning = {};
            take(actions_.body_impulses, index, acts.impulse, acts.twist);
            take(actions_.body_velocities, index, acts.velocity, acts.turning);
            acts.sets =
                !actions_.body_velocities.empty() && (actions_.body_sets.empty() || actions_.body_sets[index] != 0);
            acts.given += most_given(bodies[k], to_ - from_);
            // Velocities are those in the middle of substeps, so half a substep of the force is past as it changes.
            const double half = 0.5 * (to_ - from_) / model_.scene.solver.substeps;
            acts.impulse = plus(acts.impulse, times(half, minus(before.force, acts.force)));
            acts.twist = plus(acts.twist, times(half, minus(before.moment, acts.moment)));
        }
    }

  private:
    static void take(std::span<const double> numbers, std::size_t index, Vec3& first, Vec3& second) {
        if (numbers.empty()) return;
        const double* const own = &numbers[numbers_of_key * index];
        first = {own[0], own[1], own[2]};
        second = {own[3], own[4], own[5]};
    }
    /// Returns keys of a value that is `now` from this step on. The steps were made for the value `start` of time 0,
    /// and bounds know the strongest that there was, so both stay among them.
    template <class Key, class Value>
    std::vector<Key> keys_to(const Value& now, const Value& start, const Value& strongest) const {
        constexpr double soon = 1e-9;
        return {{0, start}, {soon, strongest}, {std::max(from_, 2 * soon), now}};
    }
    Vec3 vector_of(std::span<const double> all) const {
        return {all[3 * number_], all[3 * number_ + 1], all[3 * number_ + 2]};
    }
    void move(MotionPath& path, std::span<const double> numbers, std::size_t index, bool acted) const {
        if (!numbers.empty())
            go(path, from_, to_, numbers.subspan(numbers_of_key * index, numbers_of_key));
        else if (acted)
            path.keys = {key_at(path, from_)};  // it stays where the last action put it
    }
    void let_go(DynamicPin& pin, MotionPath before) const {
        if (!pin.holds(from_)) return;
        pin.release = from_;
        pin.let_go = std::move(before);
    }
    void take(DynamicPin& pin) const {
        if (!pin.holds(from_)) pin.follows = true;
        pin.release.reset();
        pin.let_go = {};
    }
    void move_pin(DynamicPin& pin, std::size_t index) const {
        MotionPath before = pin.path;
        move(pin.path, actions_.pins, index, acted_.pins);
        if (actions_.holds.empty()) return;
        if (actions_.holds[index] != 0)
            take(pin);
        else
            let_go(pin, std::move(before));
    }
    void move_hand(DynamicPin& pin) const {
        const std::size_t index = number_ * model_.options.hands.size() + *pin.hand;
        MotionPath before = pin.path;
        if (pin.path.keys.empty() && !actions_.hands.empty())
            pin.path.keys = {key_of(from_, actions_.hands.subspan(numbers_of_key * index, numbers_of_key))};
        else
            move(pin.path, actions_.hands, index, !pin.path.keys.empty());
        if (actions_.grasps.empty()) return;
        const std::optional<IndexBox> grasp = grasp_of(actions_, index);
        if (!grasp) return let_go(pin, std::move(before));
        take(pin);
        pin.held = *grasp;
    }

    const EnsembleActions& actions_;
    std::size_t number_;
    SimulationModel& model_;
    Acted& acted_;
    double from_, to_;
};

}  // namespace

bool acts(const EnsembleControls& controls) {
    return controls.wind || controls.pins || controls.colliders || controls.holds || controls.gravity ||
           controls.loads || controls.bodies || !controls.hands.empty();
}

bool is_any(const EnsembleActions& actions) {
    return !(actions.wind.empty() && actions.pins.empty() && actions.colliders.empty() && actions.holds.empty() &&
             actions.gravity.empty() && actions.hands.empty() && actions.grasps.empty() && actions.loads.empty() &&
             actions.body_forces.empty() && actions.body_impulses.empty() && actions.body_velocities.empty());
}

SceneDescription able_to_move(SceneDescription scene, const EnsembleControls& controls) {
    if (controls.pins || controls.holds)
        for (Cloth& cloth : scene.cloths)
            for (Pin& pin : cloth.pins)
                if (pin.path.keys.empty()) pin.path.keys.push_back({});
    if (controls.colliders)
        for (Collider& collider : scene.colliders)
            if (!collider.path.moves() && !collider.mass) {
                const MotionKey rest = key_at(collider.path, 0);
                collider.path.keys = {rest, rest};
                collider.path.keys[1].time = 1;
            }
    if (controls.loads && std::ranges::all_of(scene.cloths, [](const Cloth& cloth) { return cloth.loads.empty(); }))
        throw Error("controls: loads: the scene has none: give its cloths some, of 0 N");
    const auto has_mass = [](const Collider& collider) { return collider.mass.has_value(); };
    if (controls.bodies && std::ranges::none_of(scene.colliders, has_mass))
        throw Error("controls: bodies: no collider of the scene has a mass");
    for (const std::size_t cloth : controls.hands)
        if (cloth >= scene.cloths.size())
            throw Error(
                fmt::format("controls: a hand takes cloth {}; the cloths are 0 to {}", cloth, scene.cloths.size() - 1));
    return scene;
}

ModelOptions controlled(ModelOptions options, const EnsembleControls& controls) {
    options.air = options.air || controls.wind;
    options.weight = controls.gravity;
    options.holds = controls.holds;
    options.bodies = controls.bodies;
    options.hands = controls.hands;
    options.acts = acts(controls);
    return options;
}

void act(const EnsembleActions& actions, std::size_t number, std::uint32_t frame, SimulationModel& model,
         Acted& acted) {
    Acting acting(actions, number, frame, model, acted);
    acting.blow();
    acting.weigh();
    acting.load();
    acting.move_pins();
    acting.move_colliders();
    acting.push_bodies();
}

}  // namespace drape
